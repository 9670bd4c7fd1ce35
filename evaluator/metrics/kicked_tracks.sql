-- Releases of kicks and sightings of the ball by the flight camera, in the order of their time.
-- Columns: session_id, t_ns, ball_x_m, ball_y_m, ball_z_m (NULL: a release).
SELECT session_id, release_t_ns AS t_ns, NULL AS ball_x_m, NULL AS ball_y_m, NULL AS ball_z_m
FROM kicks WHERE accepted = 1 AND release_t_ns IS NOT NULL
UNION ALL
SELECT session_id, t_exposure_ns, ball_x_m, ball_y_m, ball_z_m
FROM flight_frames WHERE ball_seen = 1
ORDER BY session_id, t_ns;
