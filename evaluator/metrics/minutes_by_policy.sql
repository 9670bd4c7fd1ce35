-- Minutes of play in the possessions of each policy, summed over the sessions: the policy that a possession was assigned
-- to, else the half's. A word of the referee holds until the next one of the same half; where several robots heard him,
-- the longest span counts.
-- Columns: policy, played_min (NULL: the referee was not recorded).
WITH
  words AS (
    SELECT session_id, robot_id, half, possession_id, playing,
      lead(t_ns) OVER (PARTITION BY session_id, robot_id, half ORDER BY t_ns) - t_ns AS span_ns
    FROM referee),
  heard AS (
    SELECT session_id, robot_id, half, possession_id, sum(span_ns) AS played_ns
    FROM words
    WHERE playing = 1
    GROUP BY session_id, robot_id, half, possession_id),
  possessions AS (
    SELECT session_id, half, possession_id, max(played_ns) AS played_ns
    FROM heard
    GROUP BY session_id, half, possession_id),
  assigned AS (
    SELECT session_id, half, possession_id, min(policy) AS policy
    FROM assignments
    GROUP BY session_id, half, possession_id),
  played AS (
    SELECT coalesce(a.policy, h.policy) AS policy, played_ns
    FROM possessions AS p
    LEFT JOIN assigned AS a USING (session_id, half, possession_id)
    LEFT JOIN session_policies AS h ON h.session_id = p.session_id AND h.half = p.half
    UNION ALL
    SELECT policy, NULL FROM session_policies)
SELECT policy, sum(played_ns) / 60e9 AS played_min
FROM played
WHERE policy IS NOT NULL
GROUP BY policy
ORDER BY policy;
