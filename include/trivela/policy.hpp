#pragma once

#include <memory>
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

/// Adds the policy of class P, made of these arguments. Throws std::invalid_argument as
/// register_policy(std::unique_ptr<Policy>) does.
template <class P, class... Arguments>
PolicyName register_policy(Arguments&&... arguments) {
  return kicking::register_policy(std::make_unique<P>(std::forward<Arguments>(arguments)...));
}

}  // namespace trivela
