-- Cycles in which a robot had to decide, by possession and by why it fired or held; where it stood in the last of them.
-- Columns: session_id, robot_id, half, possession_id (the robot's own count), policy, reason, cycles, seq (of the last
-- one), x_m, y_m.
SELECT session_id, robot_id, half, possession_id, policy, reason, count(*) AS cycles, max(seq) AS seq, x_m, y_m
FROM kick_decisions
WHERE session_id NOT IN (SELECT session_id FROM left_out_sessions)
GROUP BY session_id, robot_id, half, possession_id, policy, reason
ORDER BY session_id, robot_id, half, possession_id, policy, reason;
