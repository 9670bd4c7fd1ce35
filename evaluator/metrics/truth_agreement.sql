-- Observed outcomes beside the simulator's truth, where both are known.
-- Columns: compared, alike.
SELECT count(*) AS compared, coalesce(sum(outcome = truth_outcome), 0) AS alike
FROM counted_kicks
WHERE accepted IS NOT 0
  AND outcome <> 'unknown'
  AND truth_outcome <> 'unknown';
