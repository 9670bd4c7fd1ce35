-- Kicks of each session, robot and policy by outcome, how many of them had touched the floor before the line, and how
-- many a keeper stopped, as observed and by the simulator's truth, each among those of which it was said.
-- Columns: session_id, robot_id, policy, outcome, kicks, observed, observed_bounced, truth, truth_bounced,
-- observed_to_the_end, observed_saved, truth_to_the_end, truth_saved, by_people (kicks of
-- which somebody says goal or saved).
SELECT session_id, robot_id, policy, coalesce(label, 'unknown') AS outcome, count(*) AS kicks,
  count(bounced) AS observed, coalesce(sum(bounced), 0) AS observed_bounced,
  count(truth_bounced) AS truth, coalesce(sum(truth_bounced), 0) AS truth_bounced,
  count(saved) AS observed_to_the_end, coalesce(sum(saved), 0) AS observed_saved,
  count(truth_saved) FILTER (WHERE truth_outcome = 'on_target') AS truth_to_the_end,
  coalesce(sum(truth_saved) FILTER (WHERE truth_outcome = 'on_target'), 0) AS truth_saved,
  coalesce(sum(label_says_goals), 0) AS by_people
FROM counted_kicks
WHERE accepted IS NOT 0
GROUP BY session_id, robot_id, policy, coalesce(label, 'unknown')
ORDER BY session_id, robot_id, policy, outcome;
