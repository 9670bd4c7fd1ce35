-- Orders that the kicker's driver refused, by policy and reason. not_known: it was killed while it wrote to the device, the
-- kick counts as one.
-- Columns: policy, refusal, orders, not_fired (of them, accepted at first: a later receipt says that the coil was not energised).
SELECT k.policy, k.refusal, count(*) AS orders, CAST(total(EXISTS (
  SELECT 1 FROM main.kick_receipts AS r INDEXED BY kick_receipts_kick
  WHERE r.session_id = k.session_id AND r.robot_id = k.robot_id AND r.kick_id = k.kick_id AND r.accepted = 1 AND k.accepted = 0)) AS INTEGER)
  AS not_fired
FROM counted_kicks AS k LEFT JOIN policy_order USING (policy)
WHERE k.accepted = 0 OR k.refusal = 'not_known'
GROUP BY k.policy, k.refusal
ORDER BY place, k.refusal;
