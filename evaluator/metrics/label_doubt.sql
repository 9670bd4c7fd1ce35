-- Kicks by policy, label and sightings behind it. p_on_target: of the label's own probabilities, NULL of a label
-- by hand.
-- Columns: session_id, robot_id, policy, outcome ('unknown' where none came), observations, p_on_target, p_of_label
-- (NULL: not said), p_of_any (sum of the outcomes' probabilities, NULL: not said), release_late_s (NULL: not seen).
SELECT k.session_id, k.robot_id, k.policy, coalesce(k.label, 'unknown') AS outcome,
  coalesce(k.observations, 0) AS observations,
  c.p_on_target,
  CASE k.outcome
    WHEN 'on_target' THEN c.p_on_target WHEN 'wide_left' THEN c.p_wide_left WHEN 'wide_right' THEN c.p_wide_right
    WHEN 'over' THEN c.p_over WHEN 'short' THEN c.p_short WHEN 'post' THEN c.p_post WHEN 'bar' THEN c.p_bar
    WHEN 'blocked' THEN c.p_blocked END AS p_of_label,
  c.p_on_target + c.p_wide_left + c.p_wide_right + c.p_over + c.p_short + c.p_post + c.p_bar + c.p_blocked
    AS p_of_any,
  c.release_late_s
FROM counted_kicks AS k
LEFT JOIN kick_outcomes AS c ON k.hand_outcome IS NULL AND c.session_id = k.session_id AND c.robot_id = k.robot_id AND c.seq = (
  SELECT max(seq) FROM kick_outcomes
  WHERE session_id = k.session_id AND robot_id = k.robot_id AND kick_id = k.kick_id)
WHERE k.accepted IS NOT 0;
