-- Decisions that fired without order, receipt or outcome. A refused order has no outcome; of kicks that were imported
-- nobody has orders and receipts, and those of a replay were never made.
-- Columns: session_id, robot_id, kick_id, t_ns, policy, has_order, has_receipt, has_outcome.
SELECT session_id, robot_id, kick_id, t_ns, policy,
  order_seq IS NOT NULL AS has_order, accepted IS NOT NULL AS has_receipt, outcome IS NOT NULL AS has_outcome
FROM counted_kicks
WHERE (order_seq IS NULL
  OR accepted IS NULL
  OR (accepted = 1 AND outcome IS NULL))
  AND session_id NOT IN (SELECT session_id FROM imported_sessions)
  AND session_id NOT IN (SELECT session_id FROM sessions WHERE replays_uuid IS NOT NULL)
ORDER BY session_id, t_ns, robot_id;
