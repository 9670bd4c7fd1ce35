-- Rows of session_tallies that are not what kick_decisions and shadow_decisions say, of sessions that were counted.
-- Columns: session_id, robot_id, policy, in_charge, decisions (as counted now; 0: there are none), tallied (NULL: no row).
WITH counted AS (
  SELECT session_id, robot_id, policy, 1 AS in_charge, count(*) AS decisions, sum(fire) AS fires, min(t_ns) AS first_t_ns,
    max(t_ns) AS last_t_ns, count(DISTINCT half || ' ' || possession_id) AS possessions
  FROM kick_decisions
  GROUP BY session_id, robot_id, policy
  UNION ALL
  SELECT w.session_id, w.robot_id, w.policy, 0, count(*), sum(w.fire), min(d.t_ns), max(d.t_ns),
    count(DISTINCT d.half || ' ' || d.possession_id)
  FROM shadow_decisions AS w
  JOIN kick_decisions AS d ON d.session_id = w.session_id AND d.robot_id = w.robot_id AND d.seq = w.seq
  GROUP BY w.session_id, w.robot_id, w.policy)
SELECT c.session_id, c.robot_id, c.policy, c.in_charge, c.decisions, t.decisions AS tallied
FROM counted AS c
LEFT JOIN session_tallies AS t ON t.session_id = c.session_id AND t.robot_id = c.robot_id AND t.policy = c.policy
  AND t.in_charge = c.in_charge
WHERE c.session_id IN (SELECT session_id FROM session_tallies)
  AND (t.decisions, t.fires, t.first_t_ns, t.last_t_ns, t.possessions)
    IS NOT (c.decisions, c.fires, c.first_t_ns, c.last_t_ns, c.possessions)
UNION ALL
SELECT t.session_id, t.robot_id, t.policy, t.in_charge, 0, t.decisions
FROM session_tallies AS t
WHERE NOT EXISTS (SELECT 1 FROM counted AS c WHERE c.session_id = t.session_id AND c.robot_id = t.robot_id
  AND c.policy = t.policy AND c.in_charge = t.in_charge)
ORDER BY 1, 2, 3, 4;
