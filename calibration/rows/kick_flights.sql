-- Kicks that the driver accepted, with the state that they were decided in and what was seen of their flights.
-- Columns: session_id, robot_id, kick_id, simulated, t_ns, utc_ns, release_t_ns (expected), fired_t_ns, power, x_m, y_m,
-- heading_rad, vx_mps, vy_mps, omega_radps, flight_speed_mps, flight_elevation_rad, flight_direction_rad, flight_sd_mps,
-- release_late_s (NULL: not seen).
SELECT k.session_id, k.robot_id, k.kick_id, s.simulated, k.t_ns, k.t_ns + u.utc_offset_ns AS utc_ns, k.release_t_ns,
  r.fired_t_ns, r.power, d.x_m, d.y_m, d.heading_rad, d.vx_mps, d.vy_mps, d.omega_radps,
  c.flight_speed_mps, c.flight_elevation_rad, c.flight_direction_rad, c.flight_sd_mps, c.release_late_s
FROM counted_kicks AS k
CROSS JOIN kick_decisions AS d ON d.session_id = k.session_id AND d.robot_id = k.robot_id AND d.seq = k.seq  -- this order
JOIN kick_receipts AS r ON r.session_id = k.session_id AND r.robot_id = k.robot_id AND r.kick_id = k.kick_id AND r.accepted = 1
JOIN sessions AS s ON s.session_id = k.session_id
JOIN utc_offsets AS u ON u.session_id = k.session_id
LEFT JOIN kick_outcomes AS c ON c.session_id = k.session_id AND c.robot_id = k.robot_id AND c.kick_id = k.kick_id
  AND c.seq = (SELECT max(seq) FROM kick_outcomes WHERE session_id = k.session_id AND robot_id = k.robot_id
    AND kick_id = k.kick_id AND flight_speed_mps IS NOT NULL)
WHERE k.accepted = 1
ORDER BY k.session_id, k.robot_id, k.t_ns;
