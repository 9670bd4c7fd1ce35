-- The flight camera's sightings of the ball, held or flying, in the order of what they show.
-- Columns: session_id, robot_id, t_exposure_ns, ball_x_m, ball_y_m, ball_z_m.
SELECT session_id, robot_id, t_exposure_ns, ball_x_m, ball_y_m, ball_z_m
FROM flight_frames
WHERE ball_seen = 1
ORDER BY session_id, robot_id, t_exposure_ns;
