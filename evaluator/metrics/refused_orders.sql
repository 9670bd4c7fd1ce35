-- Orders that the kicker's driver refused, by policy and reason.
-- Columns: policy, refusal, orders.
SELECT policy, refusal, count(*) AS orders
FROM counted_kicks LEFT JOIN policy_order USING (policy)
WHERE accepted = 0
GROUP BY policy, refusal
ORDER BY place, refusal;
