-- Kicks with the probability that a physical prediction gave them and what the robot saw of them: of the policy in
-- charge where that was predictive, else of its shadow in the same cycle. An order may be sent twice, an outcome
-- corrected: the first decision and the latest outcome count. Unknown outcomes and kicks that the driver did not accept
-- are left out.
-- Columns: policy, session_id, robot_id, p_on_target, distance_m, vx_mps, vy_mps, omega_radps, power,
-- opponent_distance_m, on_target, kick_id.
SELECT d.policy, d.session_id, d.robot_id,
  CASE d.policy WHEN 'predictive' THEN d.p_on_target ELSE w.p_on_target END AS p_on_target,
  d.distance_m, d.vx_mps, d.vy_mps, d.omega_radps, d.power, d.opponent_distance_m, c.outcome = 'on_target' AS on_target,
  d.kick_id
FROM kick_decisions AS d
JOIN kick_receipts AS r ON r.session_id = d.session_id AND r.robot_id = d.robot_id AND r.seq = (
  SELECT min(seq) FROM main.kick_receipts INDEXED BY kick_receipts_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id AND accepted = 1)
JOIN kick_outcomes AS c ON c.session_id = d.session_id AND c.robot_id = d.robot_id AND c.seq = (
  SELECT max(seq) FROM main.kick_outcomes INDEXED BY kick_outcomes_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
LEFT JOIN shadow_decisions AS w
  ON w.session_id = d.session_id AND w.robot_id = d.robot_id AND w.seq = d.seq AND w.policy = 'predictive'
WHERE d.fire = 1 AND d.power IS NOT NULL AND c.outcome <> 'unknown'
  AND d.seq = (
    SELECT min(seq) FROM kick_decisions INDEXED BY kick_decisions_fired
    WHERE fire = 1 AND session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
  AND CASE d.policy WHEN 'predictive' THEN d.p_on_target ELSE w.p_on_target END IS NOT NULL
ORDER BY d.session_id, d.robot_id, d.t_ns;
