-- Kicks and how far the ball had been carried: in a straight line from where it lay at the possession's first decision to
-- where it lay at the one that fired, by the robot's belief, where the log has the decisions that held, too.
-- Columns: session_id, robot_id, kick_id, policy, label, carried_m, carry_limit_m (of the rules in the session's
-- configuration; NULL: none), too_far (1: beyond it).
WITH decided AS MATERIALIZED (SELECT * FROM decided_possessions),
held AS MATERIALIZED (SELECT session_id FROM decided GROUP BY session_id HAVING sum(decisions) > sum(fires)),
named AS MATERIALIZED (
  SELECT s.session_id, t.text, instr(t.text, char(10) || 'ball_offset_m = ') AS offset_at,
    instr(t.text, char(10) || 'carry_limit_m = ') AS limit_at
  FROM sessions AS s JOIN held USING (session_id) JOIN texts AS t ON t.sha256 = s.config_sha256
),
rules AS MATERIALIZED (
  SELECT session_id,
    CASE WHEN offset_at > 0 THEN CAST(substr(text, offset_at + length(char(10) || 'ball_offset_m = ')) AS REAL) ELSE 0.0 END
      AS ball_offset_m,
    CASE WHEN limit_at > 0
      THEN nullif(CAST(substr(text, limit_at + length(char(10) || 'carry_limit_m = ')) AS REAL), 0.0) END AS carry_limit_m
  FROM named
),
carries AS (
  SELECT k.session_id, k.robot_id, k.kick_id, k.policy, k.label, k.t_ns, r.carry_limit_m,
    b.x_m - a.x_m - r.ball_offset_m * (sin(b.heading_rad) - sin(a.heading_rad)) AS dx_m,
    b.y_m - a.y_m + r.ball_offset_m * (cos(b.heading_rad) - cos(a.heading_rad)) AS dy_m
  FROM counted_kicks AS k
  JOIN rules AS r ON r.session_id = k.session_id
  JOIN decided AS p ON p.session_id = k.session_id AND p.robot_id = k.robot_id AND p.half = k.half
    AND p.possession_id = k.possession_id
  JOIN kick_decisions AS a ON a.session_id = p.session_id AND a.robot_id = p.robot_id AND a.seq = p.first_seq
  JOIN kick_decisions AS b ON b.session_id = k.session_id AND b.robot_id = k.robot_id AND b.seq = k.seq
  WHERE k.accepted IS NOT 0
)
SELECT session_id, robot_id, kick_id, policy, label, sqrt(dx_m * dx_m + dy_m * dy_m) AS carried_m, carry_limit_m,
  carry_limit_m IS NOT NULL AND dx_m * dx_m + dy_m * dy_m > carry_limit_m * carry_limit_m AS too_far
FROM carries
ORDER BY session_id, t_ns, robot_id;
