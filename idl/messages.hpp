// Every message of the wire contract: trivela::msg types with their bus::meta.
#pragma once

#include "idl/kick.hpp"
#include "idl/robot.hpp"
#include "idl/sim.hpp"
