-- After WITH wanted (session_id): the words of the referee that the robots of these sessions heard, by half.
-- Columns: session_id, robot_id, half, words, first_t_ns, last_t_ns.
SELECT r.session_id, robot_id, half, count(*) AS words, min(t_ns) AS first_t_ns, max(t_ns) AS last_t_ns
FROM wanted AS s CROSS JOIN referee AS r ON r.session_id = s.session_id
GROUP BY r.session_id, robot_id, half
