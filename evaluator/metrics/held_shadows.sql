-- Cycles in which the policy in charge held and one that rides along would have fired, by possession.
-- Columns: session_id, robot_id, half, possession_id (the robot's own count), policy, reason (why it held), shadow (the
-- policy that would have fired), cycles, p_on_target (the most that it predicted for its kick; NULL: it predicts nothing).
SELECT d.session_id, d.robot_id, d.half, d.possession_id, d.policy, d.reason, s.policy AS shadow, count(*) AS cycles,
  max(s.p_on_target) AS p_on_target
FROM shadow_decisions AS s
CROSS JOIN kick_decisions AS d ON d.session_id = s.session_id AND d.robot_id = s.robot_id AND d.seq = s.seq
WHERE s.fire = 1 AND d.fire = 0 AND d.session_id NOT IN (SELECT session_id FROM left_out_sessions)
GROUP BY d.session_id, d.robot_id, d.half, d.possession_id, d.policy, d.reason, s.policy
ORDER BY d.session_id, d.robot_id, d.half, d.possession_id, d.policy, d.reason, s.policy;
