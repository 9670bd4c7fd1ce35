-- The first decision of each possession, where the log has those that held, too: what was known before anybody decided.
-- Columns: session_id, robot_id, half, possession_id (the robot's own count), seq, distance_m, x_m,
-- opponent_distance_m (NULL: none seen).
WITH decided AS MATERIALIZED (SELECT * FROM decided_possessions),
held AS MATERIALIZED (SELECT session_id FROM decided GROUP BY session_id HAVING sum(decisions) > sum(fires))
SELECT p.session_id, p.robot_id, p.half, p.possession_id, d.seq, d.distance_m, d.x_m, d.opponent_distance_m
FROM decided AS p
JOIN kick_decisions AS d ON d.session_id = p.session_id AND d.robot_id = p.robot_id AND d.seq = p.first_seq
WHERE p.session_id IN (SELECT session_id FROM held)
ORDER BY p.session_id, p.robot_id, p.half, p.possession_id;
