-- Kicks that the driver accepted: the robot's belief at the order, and what the robot saw of the flight.
-- Columns: policy, order_t_ns, x_m, y_m, heading_rad, vx_mps, vy_mps, omega_radps, goal_line_y_m, power, x_cross_m,
-- z_cross_m (NULL: it was not seen to cross), session_id, robot_id, kick_id.
SELECT policy, order_t_ns, x_m, y_m, heading_rad, vx_mps, vy_mps, omega_radps, target_y_m AS goal_line_y_m,
  given_power AS power, x_cross_m, z_cross_m, session_id, robot_id, kick_id
FROM accepted_kicks
ORDER BY session_id, robot_id, t_ns;
