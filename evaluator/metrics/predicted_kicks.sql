-- Kicks with the probability that a physical prediction gave them and what the robot saw of them: of the policy in
-- charge where that was predictive, else of its shadow in the same cycle. Never the simulator's truth. Unknown outcomes
-- and kicks that the driver refused are left out.
-- Columns: policy, match (its number; NULL: none was given), session_id, robot_id, p_on_target, distance_m, vx_mps,
-- vy_mps, omega_radps, power, opponent_distance_m, on_target.
SELECT k.policy, s.match_id, k.session_id, k.robot_id,
  CASE k.policy WHEN 'predictive' THEN d.p_on_target ELSE w.p_on_target END AS p_on_target,
  d.distance_m, d.vx_mps, d.vy_mps, d.omega_radps, d.power, d.opponent_distance_m, k.outcome = 'on_target' AS on_target
FROM kicks AS k
JOIN sessions AS s ON s.session_id = k.session_id
JOIN kick_decisions AS d ON d.session_id = k.session_id AND d.robot_id = k.robot_id AND d.seq = k.seq
LEFT JOIN shadow_decisions AS w
  ON w.session_id = k.session_id AND w.robot_id = k.robot_id AND w.seq = k.seq AND w.policy = 'predictive'
WHERE k.accepted IS NOT 0 AND k.outcome IS NOT NULL AND k.outcome <> 'unknown' AND d.power IS NOT NULL
  AND CASE k.policy WHEN 'predictive' THEN d.p_on_target ELSE w.p_on_target END IS NOT NULL
ORDER BY k.session_id, k.robot_id, k.t_ns;
