-- Kicks that the driver accepted: the robot's belief at the order, and what the robot saw of the flight. An order may be
-- sent twice, an outcome corrected: the first decision and the latest outcome count.
-- Columns: policy, order_t_ns, x_m, y_m, heading_rad, vx_mps, vy_mps, omega_radps, goal_line_y_m, power, x_cross_m,
-- z_cross_m (NULL: it was not seen to cross), session_id, robot_id, kick_id.
SELECT d.policy, r.order_t_ns, d.x_m, d.y_m, d.heading_rad, d.vx_mps, d.vy_mps, d.omega_radps,
  d.target_y_m AS goal_line_y_m, r.power, c.x_cross_m, c.z_cross_m, d.session_id, d.robot_id, d.kick_id
FROM main.kick_decisions AS d
JOIN kick_receipts AS r ON r.session_id = d.session_id AND r.robot_id = d.robot_id AND r.seq = (
  SELECT min(seq) FROM main.kick_receipts INDEXED BY kick_receipts_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id AND accepted = 1)
LEFT JOIN kick_outcomes AS c ON c.session_id = d.session_id AND c.robot_id = d.robot_id AND c.seq = (
  SELECT max(seq) FROM main.kick_outcomes INDEXED BY kick_outcomes_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
WHERE d.fire = 1 AND d.seq = (
  SELECT min(seq) FROM main.kick_decisions INDEXED BY kick_decisions_fired
  WHERE fire = 1 AND session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
ORDER BY d.session_id, d.robot_id, d.t_ns;
