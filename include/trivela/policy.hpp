#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "kicking/policy/moving.hpp"
#include "kicking/policy/policy.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/predictive/shot_chance.hpp"
#include "kicking/policy/shot.hpp"

/// A policy in a repository of your own: a class that derives from PolicyOf<Memory>, and a program that registers it.
/// docs/own_policy.md goes through examples/own_policy line by line.
namespace trivela {

using kicking::evaluate_moving;
using kicking::evaluate_predictive;
using kicking::evaluate_stopped;
using kicking::Goal;
using kicking::MovingMemory;
using kicking::Policy;
using kicking::PolicyConfig;
using kicking::PolicyInput;
using kicking::PolicyMemory;
using kicking::PolicyName;
using kicking::PolicyOf;
using kicking::PolicyOutput;
using kicking::PossessionMemory;
using kicking::PredictiveMemory;
using kicking::Range;
using kicking::Reason;
using kicking::register_policy;
using kicking::RobotModel;
using kicking::StoppedMemory;

/// Adds the policy of class P, made of these arguments. A name or settings that cannot be end the program with exit
/// code 2 and a sentence; register_policy(std::unique_ptr<Policy>) throws std::invalid_argument there.
template <class P, class... Arguments>
PolicyName register_policy(Arguments&&... arguments) try {
  return kicking::register_policy(std::make_unique<P>(std::forward<Arguments>(arguments)...));
} catch (const std::invalid_argument& error) {
  std::fprintf(stderr, "trivela: %s\n", error.what());
  std::exit(2);
}

}  // namespace trivela
