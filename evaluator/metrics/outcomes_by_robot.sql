-- The same as outcomes_by_policy.sql for each robot.
-- Columns: robot_id, policy, outcome, kicks.
SELECT robot_id, policy, coalesce(label, 'unknown') AS outcome, count(*) AS kicks
FROM counted_kicks LEFT JOIN policy_order USING (policy)
WHERE accepted IS NOT 0
GROUP BY robot_id, policy, coalesce(label, 'unknown')
ORDER BY robot_id, place, outcome;
