-- Kicks and how far the ball had been carried: in a straight line from where it lay at the possession's first decision with
-- the ball in play to where it lay at the one that fired, by the robot's belief, where the log has the decisions that held, too.
-- Columns: session_id, robot_id, kick_id, policy, label, carried_m, carry_limit_m (of the rules in the session's
-- configuration; NULL: none), too_far (1: beyond it).
WITH held AS MATERIALIZED (
  SELECT session_id FROM decided_possessions GROUP BY session_id HAVING sum(decisions) > sum(fires))
SELECT k.session_id, k.robot_id, k.kick_id, k.policy, k.label, c.carried_m, s.carry_limit_m,
  s.carry_limit_m IS NOT NULL AND c.carried_m > s.carry_limit_m AS too_far
FROM counted_kicks AS k
JOIN session_rules AS s ON s.session_id = k.session_id
JOIN carries AS c ON c.session_id = k.session_id AND c.robot_id = k.robot_id AND c.seq = k.seq
WHERE k.accepted IS NOT 0 AND k.session_id IN (SELECT session_id FROM held)
ORDER BY k.session_id, k.t_ns, k.robot_id;
