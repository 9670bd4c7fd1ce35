-- Kicks of each policy by outcome. A refused order is no kick; an outcome that never came is unknown.
-- Columns: policy, outcome, kicks.
SELECT policy, coalesce(label, 'unknown') AS outcome, count(*) AS kicks
FROM counted_kicks LEFT JOIN policy_order USING (policy)
WHERE accepted IS NOT 0
GROUP BY policy, coalesce(label, 'unknown')
ORDER BY place, outcome;
