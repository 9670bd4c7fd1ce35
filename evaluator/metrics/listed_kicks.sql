-- Kicks that the driver did not refuse, in the order of their time: what a list of them and the timeline of each begin with.
-- Columns: session_id, robot_id, kick_id, number (of the robot's orders in its own session), t_ns, utc_ns (of the
-- decision), half, policy, distance_m, power, x_m, y_m, heading_rad, alpha_rad, target_x_m, target_y_m, aligned,
-- offset_right_m, left_m, right_m, predicted_x_cross_m, predicted_z_cross_m, predicted_t_flight_s, fired_t_ns,
-- release_t_ns (0 or NULL: not known), outcome (NULL: none came), settled_t_ns, x_cross_m, z_cross_m, sd_cross_m,
-- truth_outcome, truth_x_cross_m, truth_z_cross_m, bounced, saved (as observed; NULL: not said),
-- kick_kind (of the robot's kinds of kick, in the order of its file), possession_id (the robot's count), observed_outcome,
-- hand_outcome (a person's; NULL: nobody's), no_goal (why the rules count none of a kick on target), exit_speed_mps,
-- observations (frames with the ball), observed_p_on_target and observed_p_saved (in the light of them), truth_margin_m,
-- truth_bounced, truth_saved.
SELECT k.session_id, k.robot_id, k.kick_id, k.kick_id & 0xffffffffff AS number, k.t_ns,
  (SELECT i.utc_ns FROM kick_instants AS i
   WHERE i.session_id = k.session_id AND i.robot_id = k.robot_id AND i.kick_id = k.kick_id) AS utc_ns,
  k.half, k.policy, k.distance_m, k.power, d.x_m, d.y_m, d.heading_rad, d.alpha_rad, d.target_x_m, d.target_y_m,
  d.aligned, d.offset_right_m, d.left_m, d.right_m, k.predicted_x_cross_m, k.predicted_z_cross_m,
  d.predicted_t_flight_s, k.fired_t_ns, k.release_t_ns, k.label AS outcome,
  (SELECT c.t_ns FROM kick_outcomes AS c
   WHERE c.session_id = k.session_id AND c.robot_id = k.robot_id AND c.kick_id = k.kick_id
   ORDER BY c.seq DESC LIMIT 1) AS settled_t_ns,
  k.x_cross_m, k.z_cross_m, k.sd_cross_m, k.truth_outcome, k.truth_x_cross_m, k.truth_z_cross_m,
  k.bounced, k.saved, k.kick_kind, k.possession_id, k.outcome AS observed_outcome, k.hand_label AS hand_outcome, k.no_goal,
  k.exit_speed_mps, k.observations, k.observed_p_on_target, k.observed_p_saved, k.truth_margin_m, k.truth_bounced,
  k.truth_saved
FROM counted_kicks AS k
CROSS JOIN kick_decisions AS d ON d.session_id = k.session_id AND d.robot_id = k.robot_id AND d.seq = k.seq
WHERE k.accepted IS NOT 0
ORDER BY utc_ns, k.session_id, k.robot_id, k.kick_id;
