-- The first decision of each possession, where the log has those that held, too: what was known before anybody decided.
-- Columns: session_id, robot_id, half, possession_id (the robot's own count), seq, distance_m, x_m,
-- opponent_distance_m (NULL: none seen).
SELECT session_id, robot_id, half, possession_id, min(seq) AS seq, distance_m, x_m, opponent_distance_m
FROM kick_decisions
WHERE session_id IN (SELECT session_id FROM sessions AS s
                     WHERE EXISTS (SELECT 1 FROM kick_decisions WHERE session_id = s.session_id AND fire = 0))
GROUP BY session_id, robot_id, half, possession_id;
