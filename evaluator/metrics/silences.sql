-- Silences: streams of a robot that said nothing for more than three of their periods.
-- Columns: session_id, stream, robot_id, from_t_ns, to_t_ns (NULL: none came again), started_t_ns, counts (0: it lasted
-- to the end, and the robot's other streams with a period ended with it, within a second).
WITH voices (session_id, robot_id) AS (SELECT DISTINCT session_id, robot_id FROM losses WHERE robot_id > 0),
ends (session_id, robot_id, stream, t_ns) AS (
  SELECT v.session_id, v.robot_id, 'odometry', (SELECT t_ns FROM odometry AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'vision_frames', (SELECT t_ns FROM vision_frames AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'flight_frames', (SELECT t_ns FROM flight_frames AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'referee', (SELECT t_ns FROM referee AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'world_states', (SELECT t_ns FROM world_states AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'drive_commands', (SELECT t_ns FROM drive_commands AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v
  UNION ALL
  SELECT v.session_id, v.robot_id, 'kicker_status', (SELECT t_ns FROM kicker_status AS o
    WHERE o.session_id = v.session_id AND o.robot_id = v.robot_id ORDER BY o.seq DESC LIMIT 1) FROM voices AS v)
SELECT l.session_id, l.stream, l.robot_id, l.from_t_ns, l.to_t_ns, s.started_t_ns,
  l.to_t_ns IS NOT NULL OR EXISTS (
    SELECT 1 FROM ends AS e
    WHERE e.session_id = l.session_id AND e.robot_id = l.robot_id AND e.stream <> l.stream
      AND e.t_ns > l.from_t_ns + 1000000000) AS counts
FROM losses AS l
JOIN sessions AS s ON s.session_id = l.session_id
WHERE l.robot_id > 0
ORDER BY l.session_id, l.from_t_ns, l.robot_id, l.stream;
