-- Opportunities: the simulator's possessions, and where there are none the possessions whose policy was noted.
-- Columns: session_id, robot_id, half, possession_id, policy (NULL: not known), probability (with which it was put in
-- charge; NULL: not noted), start_x_m, start_y_m (NULL: not known).
SELECT t.session_id, t.robot_id, t.half, t.possession_id, coalesce(a.policy, o.policy, p.policy) AS policy,
  a.probability, t.start_x_m, t.start_y_m
FROM possession_truths AS t
LEFT JOIN assignments AS a USING (session_id, robot_id, half, possession_id)
LEFT JOIN session_policies AS o ON o.session_id = t.session_id AND o.robot_id = t.robot_id AND o.half = t.half
LEFT JOIN session_policies AS p ON p.session_id = t.session_id AND p.robot_id = 0 AND p.half = t.half
UNION ALL
SELECT a.session_id, a.robot_id, a.half, a.possession_id, a.policy, a.probability, NULL, NULL
FROM assignments AS a
WHERE a.possession_id <> 0 AND NOT EXISTS (SELECT 1 FROM possession_truths WHERE session_id = a.session_id);
