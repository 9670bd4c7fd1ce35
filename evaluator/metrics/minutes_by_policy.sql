-- Minutes of play in the halves of each policy, summed over the sessions. A word of the referee holds until the next
-- one of the same half; where several robots heard him, the longest span counts.
-- Columns: policy, played_min (NULL: the referee was not recorded).
WITH
  words AS (
    SELECT session_id, robot_id, half, playing,
      lead(t_ns) OVER (PARTITION BY session_id, robot_id, half ORDER BY t_ns) - t_ns AS span_ns
    FROM referee),
  heard AS (
    SELECT session_id, robot_id, half, sum(span_ns) AS played_ns
    FROM words
    WHERE playing = 1
    GROUP BY session_id, robot_id, half),
  halves AS (
    SELECT session_id, half, max(played_ns) AS played_ns
    FROM heard
    GROUP BY session_id, half)
SELECT policy, sum(played_ns) / 60e9 AS played_min
FROM session_policies
LEFT JOIN halves USING (session_id, half)
GROUP BY policy
ORDER BY policy;
