-- Opportunities by the simulator's truth: its possessions.
-- Columns: session_id, robot_id, half, possession_id (the simulator's count), policy (of the half; NULL: not known),
-- start_x_m, start_y_m.
SELECT t.session_id, t.robot_id, t.half, t.possession_id, coalesce(o.policy, p.policy) AS policy, t.start_x_m, t.start_y_m
FROM possession_truths AS t
LEFT JOIN session_policies AS o ON o.session_id = t.session_id AND o.robot_id = t.robot_id AND o.half = t.half
LEFT JOIN session_policies AS p ON p.session_id = t.session_id AND p.robot_id = 0 AND p.half = t.half;
