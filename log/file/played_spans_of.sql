-- After WITH wanted (session_id): play by possession of these sessions, by their own clocks. A word of the referee holds
-- until the next one of the same half. A simulator's referee counts the possessions. Elsewhere each robot counts its own:
-- that robot's word of them, from the first one that it has the ball.
-- Columns: session_id, of_robot (NULL: of all), robot_id (that heard it), half, possession_id, from_t_ns, to_t_ns,
-- played_ns.
, counting AS (
    SELECT session_id,
      EXISTS (SELECT 1 FROM world_states AS w WHERE w.session_id = s.session_id AND w.possession_id <> 0)
      AND NOT (EXISTS (SELECT 1 FROM possession_truths AS t WHERE t.session_id = s.session_id)
        AND EXISTS (SELECT 1 FROM referee AS r WHERE r.session_id = s.session_id AND r.possession_id <> 0)) AS by_robot
    FROM wanted AS s),
  words AS (
    SELECT r.session_id, NULL AS of_robot, r.robot_id, half, possession_id, playing, t_ns, t_ns AS gained_t_ns
    FROM counting AS c CROSS JOIN referee AS r ON r.session_id = c.session_id WHERE NOT c.by_robot
    UNION ALL
    SELECT w.session_id, w.robot_id, w.robot_id, half, possession_id, playing, t_ns,
      min(CASE WHEN possession = 1 THEN t_ns END) OVER (PARTITION BY w.session_id, w.robot_id, half, possession_id)
    FROM counting AS c CROSS JOIN world_states AS w ON w.session_id = c.session_id WHERE c.by_robot),
  held AS (
    SELECT session_id, of_robot, robot_id, half, possession_id, playing, t_ns, gained_t_ns,
      lead(t_ns) OVER (PARTITION BY session_id, robot_id, half ORDER BY t_ns) AS next_t_ns
    FROM words)
SELECT session_id, of_robot, robot_id, half, possession_id, min(t_ns) AS from_t_ns, max(next_t_ns) AS to_t_ns,
  sum(next_t_ns - t_ns) AS played_ns
FROM held
WHERE playing = 1 AND next_t_ns IS NOT NULL AND t_ns >= gained_t_ns
GROUP BY session_id, of_robot, robot_id, half, possession_id
