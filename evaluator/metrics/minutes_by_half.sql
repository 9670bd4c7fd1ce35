-- Minutes of play of each half, with its policy. A word of the referee holds until the next one of the same half; where
-- several robots heard him, the longest span counts.
-- Columns: session_id, half, policy (NULL: drawn for each possession), played_min.
WITH
  words AS (
    SELECT session_id, robot_id, half, playing,
      lead(t_ns) OVER (PARTITION BY session_id, robot_id, half ORDER BY t_ns) - t_ns AS span_ns
    FROM referee),
  heard AS (
    SELECT session_id, robot_id, half, sum(span_ns) AS played_ns
    FROM words
    WHERE playing = 1
    GROUP BY session_id, robot_id, half)
SELECT h.session_id, h.half, p.policy, max(h.played_ns) / 60e9 AS played_min
FROM heard AS h
LEFT JOIN session_policies AS p USING (session_id, half)
GROUP BY h.session_id, h.half
HAVING played_min > 0;
