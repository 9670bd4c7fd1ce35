-- Kicks that somebody labelled by hand, in the order of their time, with what the observer had said of them: the latest
-- label of a kick holds, unless it is withdrawn.
-- Columns: session_id, robot_id, kick_id, number (of the robot's orders in its own session), t_ns, policy, outcome (by hand),
-- observed (goal, saved where that is known; NULL: no outcome came), who, labelled_utc_ns, note.
SELECT k.session_id, k.robot_id, k.kick_id, k.kick_id & 0xffffffffff AS number, k.t_ns, k.policy,
  h.label AS outcome,
  k.observed, h.who, h.utc_ns AS labelled_utc_ns, h.note
FROM counted_kicks AS k
JOIN hand_labels AS h ON h.session_id = k.session_id AND h.robot_id = k.robot_id AND h.kick_id = k.kick_id
WHERE k.accepted IS NOT 0
ORDER BY k.session_id, k.t_ns, k.robot_id;
