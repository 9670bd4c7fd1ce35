-- Kicks with the probability that a physical prediction gave them and what the robot saw of them: of the policy in
-- charge where that was predictive, else of its shadow in the same cycle. Unknown outcomes and kicks that the driver did
-- not accept are left out.
-- Columns: policy, session_id, robot_id, p_on_target, distance_m, vx_mps, vy_mps, omega_radps, power,
-- opponent_distance_m, on_target, kick_id, p_goal (NULL: no keeper was tracked), goal (NULL: not known).
SELECT k.policy, k.session_id, k.robot_id,
  CASE k.policy WHEN 'predictive' THEN k.p_on_target ELSE w.p_on_target END AS p_on_target,
  k.distance_m, k.vx_mps, k.vy_mps, k.omega_radps, k.power, k.opponent_distance_m,
  k.outcome = 'on_target' AS on_target, k.kick_id,
  CASE k.policy WHEN 'predictive' THEN k.p_goal ELSE w.p_goal END AS p_goal,
  CASE WHEN k.outcome <> 'on_target' THEN 0 ELSE k.saved = 0 END AS goal
FROM accepted_kicks AS k
LEFT JOIN shadow_decisions AS w
  ON w.session_id = k.session_id AND w.robot_id = k.robot_id AND w.seq = k.seq AND w.policy = 'predictive'
WHERE k.power IS NOT NULL AND k.outcome <> 'unknown'
  AND CASE k.policy WHEN 'predictive' THEN k.p_on_target ELSE w.p_on_target END IS NOT NULL
ORDER BY k.session_id, k.robot_id, k.t_ns;
