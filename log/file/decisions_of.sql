-- After WITH wanted (session_id): what the policies of these sessions decided.
-- Columns: those of session_tallies.
, decided AS (
    SELECT d.session_id, robot_id, policy, 1 AS in_charge, count(*) AS decisions, sum(fire) AS fires,
      min(t_ns) AS first_t_ns, max(t_ns) AS last_t_ns
    FROM wanted AS s CROSS JOIN kick_decisions AS d ON d.session_id = s.session_id
    GROUP BY d.session_id, robot_id, policy, half, possession_id
    UNION ALL
    SELECT h.session_id, h.robot_id, h.policy, 0, count(*), sum(h.fire), min(d.t_ns), max(d.t_ns)
    FROM wanted AS s CROSS JOIN shadow_decisions AS h ON h.session_id = s.session_id
    CROSS JOIN kick_decisions AS d ON d.session_id = h.session_id AND d.robot_id = h.robot_id AND d.seq = h.seq
    GROUP BY h.session_id, h.robot_id, h.policy, d.half, d.possession_id)
SELECT session_id, robot_id, policy, in_charge, sum(decisions) AS decisions, sum(fires) AS fires,
  min(first_t_ns) AS first_t_ns, max(last_t_ns) AS last_t_ns, count(*) AS possessions
FROM decided
GROUP BY session_id, robot_id, policy, in_charge
