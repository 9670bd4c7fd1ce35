-- Spans of play by possession (log/file/played_spans_of.sql).
-- Columns: session_id, of_robot (NULL: of all), half, possession_id, from_ns, to_ns (by UTC, in lockstep by the
-- simulator's clock), played_ns.
SELECT p.session_id, of_robot, half, possession_id, from_t_ns + offset_ns AS from_ns, to_t_ns + offset_ns AS to_ns,
  played_ns
FROM played_possessions AS p
JOIN (SELECT session_id, CASE clock WHEN 'steady' THEN realtime_offset_ns ELSE 0 END AS offset_ns FROM sessions) AS s
  ON s.session_id = p.session_id
ORDER BY p.session_id, of_robot, robot_id, half, possession_id;
