-- Kicks that the driver did not refuse, in the order of their time.
-- Columns: session_id, robot_id, half, possession_id (the robot's own count), true_possession_id (the simulator's; NULL:
-- it has no truth of the kick), policy, outcome (a label by hand before the observer's), truth_outcome (NULL: not known;
-- of both: own_half or carried_too_far on target where the rules count no goal), distance_m (NULL: of an imported kick),
-- observed_p_on_target, bounced, truth_bounced, saved, truth_saved (NULL: not said, or not on target by the truth),
-- label_says_goals (1: somebody says goal or saved), kick_id. A label by hand has no
-- observed_p_on_target.
SELECT session_id, robot_id, half, possession_id,
  (SELECT max(t.possession_id) FROM kick_truths AS t
   WHERE t.session_id = k.session_id AND t.robot_id = k.robot_id AND t.kick_id = k.kick_id) AS true_possession_id,
  policy, label AS outcome,
  CASE WHEN truth_outcome = 'on_target' THEN coalesce(no_goal, truth_outcome) ELSE truth_outcome END AS truth_outcome,
  CASE WHEN session_id IN (SELECT session_id FROM imported_sessions) THEN NULL ELSE distance_m END AS distance_m,
  CASE WHEN hand_outcome IS NULL THEN observed_p_on_target END AS observed_p_on_target, bounced, truth_bounced, saved,
  CASE WHEN truth_outcome = 'on_target' THEN truth_saved END AS truth_saved, label_says_goals, kick_id
FROM labelled_kicks AS k
WHERE accepted IS NOT 0
ORDER BY session_id, t_ns, robot_id;
