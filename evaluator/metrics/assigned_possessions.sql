-- Possessions by the robots' own count, with who was in charge of them.
-- Columns: session_id, robot_id, half, possession_id (0: nobody counted), t_ns (first decision in play; NULL: not noted),
-- policy, probability (with which it was put in charge).
SELECT session_id, robot_id, half, possession_id, t_ns, policy, probability
FROM assignments
ORDER BY session_id, robot_id, half, possession_id;
