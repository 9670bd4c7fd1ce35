-- After WITH wanted (session_id): what the kickers' drivers of these sessions counted. A driver that starts again counts
-- from 0.
-- Columns: session_id, robot_id, first_t_ns, first_handled, first_refused (of the first status), handled_within,
-- refused_within (from there to the last status).
, steps AS (
    SELECT k.session_id, robot_id, seq, t_ns, orders_handled AS handled, orders_refused AS refused,
      lag(orders_handled) OVER by_seq AS handled_before, lag(orders_refused) OVER by_seq AS refused_before
    FROM wanted AS s CROSS JOIN kicker_status AS k ON k.session_id = s.session_id
    WINDOW by_seq AS (PARTITION BY k.session_id, robot_id ORDER BY seq))
SELECT session_id, robot_id,
  max(t_ns) FILTER (WHERE handled_before IS NULL) AS first_t_ns,
  max(handled) FILTER (WHERE handled_before IS NULL) AS first_handled,
  max(refused) FILTER (WHERE handled_before IS NULL) AS first_refused,
  CAST(total(handled - CASE WHEN handled >= handled_before THEN handled_before ELSE 0 END)
    FILTER (WHERE handled_before IS NOT NULL) AS INTEGER) AS handled_within,
  CAST(total(refused - CASE WHEN handled >= handled_before THEN refused_before ELSE 0 END)
    FILTER (WHERE handled_before IS NOT NULL) AS INTEGER) AS refused_within
FROM steps
GROUP BY session_id, robot_id
