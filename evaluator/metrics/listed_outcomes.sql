-- What became of the kicks that count, in the order of their robots' decisions: the robot's own view, what people said, and
-- the simulator's truth.
-- Columns: session_id, robot_id, kick_id, t_ns (of the decision), half, possession_id, policy, outcome (what counts; NULL:
-- none came), observed_outcome, hand_outcome (a person's; NULL: nobody's), no_goal (why the rules count none of a kick on
-- target), x_cross_m, z_cross_m, sd_cross_m, exit_speed_mps, observations (frames with the ball), p_on_target and p_saved
-- (in the light of the sightings), bounced, saved, truth_outcome, truth_x_cross_m, truth_z_cross_m, truth_margin_m,
-- truth_bounced, truth_saved (NULL: not known).
SELECT session_id, robot_id, kick_id, t_ns, half, possession_id, policy, label AS outcome, outcome AS observed_outcome,
  hand_label AS hand_outcome, no_goal, x_cross_m, z_cross_m, sd_cross_m, exit_speed_mps, observations,
  observed_p_on_target AS p_on_target, observed_p_saved AS p_saved, bounced, saved, truth_outcome, truth_x_cross_m,
  truth_z_cross_m, truth_margin_m, truth_bounced, truth_saved
FROM counted_kicks
WHERE accepted IS NOT 0
ORDER BY session_id, robot_id, t_ns, kick_id;
