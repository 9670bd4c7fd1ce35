-- After WITH wanted (session_id): the decisions of these sessions by possession, by the robots' own count.
-- Columns: session_id, robot_id, half, possession_id, first_seq, decisions, fires.
SELECT d.session_id, robot_id, half, possession_id, min(seq) AS first_seq, count(*) AS decisions, sum(fire) AS fires
FROM wanted AS s CROSS JOIN kick_decisions AS d ON d.session_id = s.session_id
GROUP BY d.session_id, robot_id, half, possession_id
