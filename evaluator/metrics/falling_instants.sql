-- Streams of a robot whose instants fall back although their numbers rise: its clock was set, or another one took its place.
-- Columns: session_id, stream, robot_id, falls, largest_ns (fall), at_t_ns (of the row after the first fall).
WITH rows (session_id, stream, robot_id, seq, t_ns) AS (
  SELECT session_id, 'odometry', robot_id, seq, t_ns FROM odometry
  UNION ALL
  SELECT session_id, 'world_states', robot_id, seq, t_ns FROM world_states
  UNION ALL
  SELECT session_id, 'kicker_status', robot_id, seq, t_ns FROM kicker_status),
steps AS (
  SELECT session_id, stream, robot_id, t_ns, lag(t_ns) OVER (PARTITION BY session_id, stream, robot_id ORDER BY seq) AS before_t_ns
  FROM rows)
SELECT session_id, stream, robot_id, count(*) AS falls, max(before_t_ns - t_ns) AS largest_ns, min(t_ns) AS at_t_ns
FROM steps
WHERE before_t_ns > t_ns
GROUP BY session_id, stream, robot_id
ORDER BY session_id, robot_id, stream;
