-- Spans of play by possession: a word of the referee holds until the next one of the same half. A simulator's referee
-- counts the possessions. Elsewhere each robot counts its own: that robot's word of them, from the first one that it has
-- the ball.
-- Columns: session_id, of_robot (NULL: of all), half, possession_id, from_ns, to_ns (by UTC, in lockstep by the
-- simulator's clock), played_ns.
WITH
  counting AS (
    SELECT s.session_id, CASE clock WHEN 'steady' THEN realtime_offset_ns ELSE 0 END AS offset_ns,
      EXISTS (SELECT 1 FROM world_states AS w WHERE w.session_id = s.session_id AND w.possession_id <> 0)
      AND NOT (EXISTS (SELECT 1 FROM possession_truths AS t WHERE t.session_id = s.session_id)
        AND EXISTS (SELECT 1 FROM referee AS r WHERE r.session_id = s.session_id AND r.possession_id <> 0)) AS by_robot
    FROM sessions AS s),
  words AS (
    SELECT r.session_id, NULL AS of_robot, r.robot_id, half, possession_id, playing, t_ns, t_ns AS gained_t_ns
    FROM referee AS r JOIN counting AS c ON c.session_id = r.session_id AND NOT c.by_robot
    UNION ALL
    SELECT w.session_id, w.robot_id, w.robot_id, half, possession_id, playing, t_ns,
      min(CASE WHEN possession = 1 THEN t_ns END) OVER (PARTITION BY w.session_id, w.robot_id, half, possession_id)
    FROM world_states AS w JOIN counting AS c ON c.session_id = w.session_id AND c.by_robot),
  held AS (
    SELECT session_id, of_robot, robot_id, half, possession_id, playing, t_ns, gained_t_ns,
      lead(t_ns) OVER (PARTITION BY session_id, robot_id, half ORDER BY t_ns) AS next_t_ns
    FROM words)
SELECT h.session_id, of_robot, half, possession_id, min(t_ns) + offset_ns AS from_ns,
  max(next_t_ns) + offset_ns AS to_ns, sum(next_t_ns - t_ns) AS played_ns
FROM held AS h
JOIN counting AS c ON c.session_id = h.session_id
WHERE playing = 1 AND next_t_ns IS NOT NULL AND t_ns >= gained_t_ns
GROUP BY h.session_id, of_robot, h.robot_id, half, possession_id;
