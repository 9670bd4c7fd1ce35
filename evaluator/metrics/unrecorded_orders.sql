-- Orders and kicks that a kicker's driver counted and the log has no receipt of, by session and robot, where there are
-- any. A driver that starts again counts from 0. A withdrawn kick, and one of which it is not known whether it fired, has two receipts of one order.
-- Columns: session_id, robot_id, continues (1: the session goes on from another), restarted_before (1: the driver was
-- started again between the two, what it did before that is not known), orders_before, kicks_before (before the
-- session's first status; where it continues another: since that one's last), orders_within, kicks_within (between the
-- session's first status and its last).
WITH counts AS MATERIALIZED (SELECT * FROM driver_counts),
firsts AS (
  SELECT f.session_id, f.robot_id, f.first_t_ns AS t_ns, f.first_handled AS handled, f.first_refused AS refused,
    f.handled_within, f.refused_within, s.continues_uuid IS NOT NULL AS continues,
    coalesce(f.first_handled < c.orders_handled, 0) AS restarted,
    CASE WHEN f.first_handled >= c.orders_handled THEN c.orders_handled ELSE 0 END AS handled_there,
    CASE WHEN f.first_handled >= c.orders_handled THEN c.orders_refused ELSE 0 END AS refused_there
  FROM counts AS f
  JOIN sessions AS s ON s.session_id = f.session_id
  LEFT JOIN continued AS c ON c.session_id = f.session_id AND c.robot_id = f.robot_id),
receipts AS (
  SELECT r.session_id, r.robot_id, r.t_ns, r.accepted,
    r.accepted = 0 AND r.refusal <> 'double' AND EXISTS (
      SELECT 1 FROM main.kick_receipts AS k INDEXED BY kick_receipts_kick
      WHERE k.session_id = r.session_id AND k.robot_id = r.robot_id AND k.kick_id = r.kick_id AND k.seq < r.seq
        AND k.accepted = 1) AS withdrawal
  FROM kick_receipts AS r WHERE r.refusal <> 'not_known'),
recorded AS (
  SELECT f.session_id, f.robot_id,
    total(r.t_ns <= f.t_ns AND NOT r.withdrawal) AS orders_before,
    total((r.t_ns <= f.t_ns) * (r.accepted - r.withdrawal)) AS kicks_before,
    total(r.t_ns > f.t_ns AND NOT r.withdrawal) AS orders_within,
    total((r.t_ns > f.t_ns) * (r.accepted - r.withdrawal)) AS kicks_within
  FROM firsts AS f
  LEFT JOIN receipts AS r ON r.session_id = f.session_id AND r.robot_id = f.robot_id
  GROUP BY f.session_id, f.robot_id),
missing AS (
  SELECT f.session_id, f.robot_id, f.continues, f.restarted AS restarted_before,
    max(0, f.handled - f.handled_there - CAST(n.orders_before AS INTEGER)) AS orders_before,
    max(0, f.handled - f.refused - (f.handled_there - f.refused_there) - CAST(n.kicks_before AS INTEGER))
      AS kicks_before,
    max(0, f.handled_within - CAST(n.orders_within AS INTEGER)) AS orders_within,
    max(0, f.handled_within - f.refused_within - CAST(n.kicks_within AS INTEGER)) AS kicks_within
  FROM firsts AS f
  JOIN recorded AS n ON n.session_id = f.session_id AND n.robot_id = f.robot_id)
SELECT session_id, robot_id, continues, restarted_before, orders_before, kicks_before, orders_within, kicks_within
FROM missing
WHERE orders_before > 0 OR kicks_before > 0 OR orders_within > 0 OR kicks_within > 0 OR restarted_before
ORDER BY session_id, robot_id;
