-- What match logs before version 4 lack alike: views of this connection that stand before their tables. What they did not
-- have is NULL or what was true then.
CREATE TEMP VIEW session_policies AS
SELECT session_id, 0 AS robot_id, half, policy FROM main.session_policies;

CREATE TEMP VIEW kick_outcomes AS
SELECT o.*, NULL AS p_on_target, NULL AS p_wide_left, NULL AS p_wide_right, NULL AS p_over, NULL AS p_short,
  NULL AS p_post, NULL AS p_bar, NULL AS p_blocked, NULL AS bounced, NULL AS residual_sd_m
FROM main.kick_outcomes AS o;

CREATE TEMP VIEW observed_kicks AS
SELECT k.*, c.observations
FROM kicks_of_version_3 AS k
LEFT JOIN main.kick_outcomes AS c ON c.session_id = k.session_id AND c.robot_id = k.robot_id AND c.seq = (
  SELECT max(seq) FROM main.kick_outcomes INDEXED BY kick_outcomes_kick
  WHERE session_id = k.session_id AND robot_id = k.robot_id AND kick_id = k.kick_id);
