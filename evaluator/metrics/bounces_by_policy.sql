-- Kicks inside by policy, and how many of them had touched the floor before the line: as observed, and by the simulator's
-- truth. Each is counted among the kicks of which it was said.
-- Columns: policy, observed, observed_bounced, truth, truth_bounced.
SELECT policy, count(bounced) AS observed, coalesce(sum(bounced), 0) AS observed_bounced,
  count(truth_bounced) AS truth, coalesce(sum(truth_bounced), 0) AS truth_bounced
FROM counted_kicks LEFT JOIN policy_order USING (policy)
WHERE accepted IS NOT 0
  AND label = 'on_target'
GROUP BY policy
ORDER BY place;
