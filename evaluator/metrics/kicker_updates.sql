-- What each kick changed in what its robot believes of its kicker ([self_calibration]); the row of kick_id 0 is before
-- the first kick. Differences from the robot's file, to be added to it, with standard errors.
-- Columns: session_id, robot_id, seq, kick_id, kicks (learned from), used (1: decisions went by it), speed_ln_before,
-- speed_ln, speed_ln_se, elevation_rad_before, elevation_rad, elevation_se_rad, direction_rad_before, direction_rad,
-- direction_se_rad, delay_s_before, delay_s, delay_se_s, along_ratio, along_se_ratio, sideways_ratio, sideways_se_ratio,
-- p_mistaken, p_jump, chi_square (4 on average where all is right), distance_m, t_flight_s, flight_elevation_rad (of the
-- kick; NULL: not known).
SELECT e.session_id, e.robot_id, e.seq, e.kick_id, e.kicks, e.used,
  lag(e.speed_ln) OVER series AS speed_ln_before, e.speed_ln, e.speed_ln_se,
  lag(e.elevation_rad) OVER series AS elevation_rad_before, e.elevation_rad, e.elevation_se_rad,
  lag(e.direction_rad) OVER series AS direction_rad_before, e.direction_rad, e.direction_se_rad,
  lag(e.delay_s) OVER series AS delay_s_before, e.delay_s, e.delay_se_s,
  e.along_ratio, e.along_se_ratio, e.sideways_ratio, e.sideways_se_ratio, e.p_mistaken, e.p_jump, e.chi_square,
  k.distance_m, d.predicted_t_flight_s AS t_flight_s, c.flight_elevation_rad
FROM kicker_estimates AS e
LEFT JOIN kicks AS k ON k.session_id = e.session_id AND k.robot_id = e.robot_id AND k.kick_id = e.kick_id
LEFT JOIN kick_decisions AS d ON d.session_id = k.session_id AND d.robot_id = k.robot_id AND d.seq = k.seq
LEFT JOIN kick_outcomes AS c ON c.session_id = e.session_id AND c.robot_id = e.robot_id AND c.kick_id = e.kick_id
  AND c.seq = (SELECT max(seq) FROM kick_outcomes WHERE session_id = e.session_id AND robot_id = e.robot_id
    AND kick_id = e.kick_id AND flight_elevation_rad IS NOT NULL)
WINDOW series AS (PARTITION BY e.session_id, e.robot_id ORDER BY e.seq)
ORDER BY e.session_id, e.robot_id, e.seq;
