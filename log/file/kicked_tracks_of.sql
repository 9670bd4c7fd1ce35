-- After WITH wanted (session_id): releases of kicks of these sessions and sightings of the ball by the flight camera, in
-- the order of their time.
-- Columns: session_id, t_ns, ball_x_m, ball_y_m (NULL: a release).
SELECT k.session_id AS session_id, release_t_ns AS t_ns, NULL AS ball_x_m, NULL AS ball_y_m
FROM wanted AS s CROSS JOIN kicks AS k ON k.session_id = s.session_id
WHERE accepted = 1 AND release_t_ns IS NOT NULL
UNION ALL
SELECT f.session_id AS session_id, t_exposure_ns, ball_x_m, ball_y_m
FROM wanted AS s CROSS JOIN flight_frames AS f ON f.session_id = s.session_id
WHERE ball_seen = 1
ORDER BY session_id, t_ns
