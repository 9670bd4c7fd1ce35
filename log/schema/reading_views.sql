-- Tables and views of the connection that reads a match log of any version.
-- Of what is left out nothing yet.
CREATE TEMP TABLE left_out_sessions (session_id INTEGER NOT NULL PRIMARY KEY) STRICT;
CREATE TEMP TABLE left_out_kicks (session_id INTEGER NOT NULL, robot_id INTEGER NOT NULL, kick_id INTEGER NOT NULL,
  PRIMARY KEY (session_id, robot_id, kick_id)) STRICT, WITHOUT ROWID;
-- Sessions that no robot recorded (kImportMark, log/schema/session.hpp).
CREATE TEMP VIEW imported_sessions AS
SELECT session_id FROM sessions
WHERE config_sha256 IN (SELECT sha256 FROM texts WHERE substr(text, 1, 11) = '### import' || char(10));
-- What each session's configuration says: how far before a robot's centre the ball lies, and [rules] by which no goal
-- counts from the own half (opponents_half_only) or after the ball was carried farther than carry_limit_m (NULL: however far).
CREATE TEMP VIEW session_rules AS
SELECT session_id,
  CASE WHEN offset_at > 0 THEN CAST(substr(text, offset_at + length(char(10) || 'ball_offset_m = ')) AS REAL) ELSE 0.0 END
    AS ball_offset_m,
  instr(text, char(10) || 'opponents_half_only = true' || char(10)) > 0 AS opponents_half_only,
  CASE WHEN limit_at > 0
    THEN nullif(CAST(substr(text, limit_at + length(char(10) || 'carry_limit_m = ')) AS REAL), 0.0) END AS carry_limit_m
FROM (
  SELECT s.session_id, t.text, instr(t.text, char(10) || 'ball_offset_m = ') AS offset_at,
    instr(t.text, char(10) || 'carry_limit_m = ') AS limit_at
  FROM sessions AS s JOIN texts AS t ON t.sha256 = s.config_sha256);
CREATE TEMP VIEW ruled_sessions AS
SELECT session_id FROM session_rules WHERE opponents_half_only OR carry_limit_m IS NOT NULL;
-- How far the ball had been carried when a decision fired, in a straight line by the robot's belief, from where it lay at
-- the possession's first decision with the ball in play; that follows the possession's first one, which the tallies name,
-- else the last one of another possession.
CREATE TEMP VIEW carries AS
SELECT d.session_id, d.robot_id, d.seq,
  sqrt(pow(d.x_m - a.x_m - s.ball_offset_m * (sin(d.heading_rad) - sin(a.heading_rad)), 2)
    + pow(d.y_m - a.y_m + s.ball_offset_m * (cos(d.heading_rad) - cos(a.heading_rad)), 2)) AS carried_m
FROM kick_decisions AS d
JOIN session_rules AS s ON s.session_id = d.session_id
JOIN kick_decisions AS a ON a.session_id = d.session_id AND a.robot_id = d.robot_id AND a.seq = (
  SELECT seq FROM kick_decisions
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND reason NOT IN ('not_playing', 'no_ball', 'stale_state')
    AND seq >= coalesce((
      SELECT first_seq FROM possession_tallies
      WHERE session_id = d.session_id AND robot_id = d.robot_id AND half = d.half AND possession_id = d.possession_id
        AND counted_by = 'robot' AND session_id IN (SELECT session_id FROM counted_sessions)), 1 + (
      SELECT seq FROM kick_decisions
      WHERE session_id = d.session_id AND robot_id = d.robot_id AND seq < d.seq
        AND (half <> d.half OR possession_id <> d.possession_id)
      ORDER BY seq DESC LIMIT 1), 0)
  ORDER BY seq LIMIT 1)
WHERE d.fire = 1;
-- Labels that other logs have of the same sessions.
CREATE TEMP TABLE labels_elsewhere (uuid TEXT NOT NULL, robot_id INTEGER NOT NULL, kick_id INTEGER NOT NULL,
  utc_ns INTEGER NOT NULL, who TEXT NOT NULL, t_ns INTEGER NOT NULL, outcome TEXT, note TEXT NOT NULL) STRICT;
CREATE TEMP VIEW all_labels AS
SELECT session_id, robot_id, kick_id, utc_ns, who, t_ns, outcome, note FROM main.labels
UNION SELECT s.session_id, e.robot_id, e.kick_id, e.utc_ns, e.who, e.t_ns, e.outcome, e.note
FROM labels_elsewhere AS e JOIN main.sessions AS s ON s.uuid = e.uuid;
-- What people say of kicks: the latest label of each, unless it is withdrawn, for every recording of that kick in the log.
-- An experiment's kicks are nobody else's.
-- goal and saved are on_target in outcome, and stand as they are in label.
CREATE TEMP VIEW hand_labels AS
SELECT session_id, robot_id, kick_id, utc_ns, who, note, outcome AS label,
  CASE WHEN outcome IN ('goal', 'saved') THEN 'on_target' ELSE outcome END AS outcome
FROM (
  SELECT s.session_id, l.robot_id, l.kick_id, l.utc_ns, l.who, l.outcome, l.note,
    row_number() OVER (PARTITION BY s.session_id, l.robot_id, l.kick_id ORDER BY l.utc_ns DESC, l.who DESC) AS place
  FROM all_labels AS l
  JOIN sessions AS own ON own.session_id = l.session_id
  JOIN sessions AS s ON s.session_id = l.session_id
    OR (s.match_id IS NULL AND own.match_id IS NULL AND s.seed IS own.seed AND EXISTS (
      SELECT 1 FROM kick_decisions AS d
      WHERE d.session_id = s.session_id AND d.robot_id = l.robot_id AND d.kick_id = l.kick_id AND d.fire = 1
        AND d.t_ns = l.t_ns)))
WHERE place = 1 AND outcome IS NOT NULL;
-- Kicks with no_goal, why the rules count none of this kick (NULL: they do): 'own_half' from where the ball lay when it
-- was decided, 'carried_too_far' by its carry; and with what counts as their outcome, label: what people say of it
-- (hand_outcome; NULL: nothing), else what the observer does (outcome). One on target that is no goal has no_goal,
-- 'outside' is one of which somebody who saw it did not say how. saved: whether a keeper stopped a kick on target (NULL:
-- not known, not on target, or no goal). label_says_goals: 1: somebody says of this kick goal or saved.
-- observed: outcome, with goal and saved where the observer knows it.
CREATE TEMP VIEW labelled_kicks AS
SELECT k.*,
  CASE WHEN k.hand_outcome IS NULL AND k.outcome = 'unknown' AND k.observed_p_on_target = 0.0
      AND k.session_id IN (SELECT session_id FROM imported_sessions)
    THEN 'outside'
    WHEN coalesce(k.hand_outcome, k.outcome) = 'on_target' THEN coalesce(k.no_goal, 'on_target')
    ELSE coalesce(k.hand_outcome, k.outcome) END AS label,
  CASE WHEN k.no_goal IS NOT NULL OR coalesce(k.hand_outcome, k.outcome) <> 'on_target' THEN NULL
    WHEN k.hand_label IN ('goal', 'saved') THEN k.hand_label = 'saved'
    WHEN k.outcome = 'on_target' THEN k.observed_p_saved > 0.5 * coalesce(k.observed_p_on_target, 1.0) END AS saved,
  coalesce(k.hand_label IN ('goal', 'saved'), 0) OR (k.observed_p_saved IS NOT NULL
    AND k.session_id IN (SELECT session_id FROM imported_sessions)) AS label_says_goals,
  CASE WHEN k.outcome <> 'on_target' OR k.observed_p_saved IS NULL THEN k.outcome
    WHEN k.observed_p_saved > 0.5 * coalesce(k.observed_p_on_target, 1.0) THEN 'saved' ELSE 'goal' END AS observed
FROM (
  SELECT j.*, h.outcome AS hand_outcome, h.label AS hand_label, coalesce(h.utc_ns, 0) AS labelled_utc_ns,
    CASE WHEN j.session_id IN (SELECT session_id FROM ruled_sessions) THEN (
      SELECT CASE WHEN s.opponents_half_only AND d.y_m + s.ball_offset_m * cos(d.heading_rad) <= 0.0 THEN 'own_half'
        WHEN s.carry_limit_m < (
          SELECT carried_m FROM carries WHERE session_id = d.session_id AND robot_id = d.robot_id AND seq = d.seq)
          THEN 'carried_too_far' END
      FROM kick_decisions AS d JOIN session_rules AS s ON s.session_id = d.session_id
      WHERE d.session_id = j.session_id AND d.robot_id = j.robot_id AND d.seq = j.seq) END AS no_goal
  FROM temp.kicks AS j
  LEFT JOIN hand_labels AS h ON h.session_id = j.session_id AND h.robot_id = j.robot_id AND h.kick_id = j.kick_id) AS k;
CREATE TEMP VIEW counted_kicks AS
SELECT k.* FROM labelled_kicks AS k
WHERE k.session_id NOT IN (SELECT session_id FROM left_out_sessions)
  AND NOT EXISTS (SELECT 1 FROM left_out_kicks AS l
    WHERE l.session_id = k.session_id AND l.robot_id = k.robot_id AND l.kick_id = k.kick_id);

-- Kicks that the driver accepted: the decision with what was given to the device and what the robot saw of the flight
-- (NULL: nothing). An order may be sent twice, an outcome corrected: the first decision, the first receipt that accepts
-- and the latest outcome count; a kick that a later receipt says was not fired is none; what people say of the kick comes before the robot's outcome.
CREATE TEMP VIEW accepted_kicks AS
SELECT d.*, r.order_t_ns, r.power AS given_power, coalesce(h.outcome, c.outcome) AS outcome, c.x_cross_m, c.z_cross_m,
  CASE WHEN h.label IN ('goal', 'saved') THEN h.label = 'saved' WHEN c.outcome = 'on_target'
    THEN c.p_saved > 0.5 * coalesce(c.p_on_target, 1.0) END AS saved
FROM kick_decisions AS d
JOIN kick_receipts AS r ON r.session_id = d.session_id AND r.robot_id = d.robot_id AND r.seq = (
  SELECT min(seq) FROM main.kick_receipts INDEXED BY kick_receipts_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id AND accepted = 1)
  AND NOT EXISTS (
    SELECT 1 FROM main.kick_receipts AS n INDEXED BY kick_receipts_kick
    WHERE n.session_id = d.session_id AND n.robot_id = d.robot_id AND n.kick_id = d.kick_id AND n.seq > r.seq
      AND n.accepted = 0 AND n.refusal <> 'double')
LEFT JOIN kick_outcomes AS c ON c.session_id = d.session_id AND c.robot_id = d.robot_id AND c.seq = (
  SELECT max(seq) FROM main.kick_outcomes INDEXED BY kick_outcomes_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
LEFT JOIN hand_labels AS h ON h.session_id = d.session_id AND h.robot_id = d.robot_id AND h.kick_id = d.kick_id
WHERE d.fire = 1 AND d.seq = (
  SELECT min(seq) FROM main.kick_decisions INDEXED BY kick_decisions_fired
  WHERE fire = 1 AND session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id);

-- UTC minus a session's clock: by the reference's clock where merging found it out, else by the recorder's own.
CREATE TEMP VIEW utc_offsets AS
SELECT s.session_id, coalesce((SELECT c.utc_offset_ns FROM session_clocks AS c
  WHERE c.session_id = s.session_id ORDER BY c.from_t_ns LIMIT 1), s.realtime_offset_ns) AS utc_offset_ns
FROM sessions AS s;

-- Kicks on one axis of time, which merging has aligned where clocks were measured: utc_ns of the decision, known to plus
-- and minus error_ns (NULL: nobody measured).
CREATE TEMP VIEW kick_instants AS
SELECT k.session_id, k.robot_id, k.kick_id, k.t_ns,
  CASE WHEN c.from_t_ns IS NULL THEN k.t_ns + s.realtime_offset_ns
    ELSE k.t_ns + c.utc_offset_ns + CAST(round(c.rate * (k.t_ns - c.from_t_ns)) AS INTEGER) END AS utc_ns,
  c.error_ns
FROM temp.kicks AS k
JOIN sessions AS s ON s.session_id = k.session_id
LEFT JOIN session_clocks AS c ON c.session_id = k.session_id AND c.from_t_ns = coalesce(
  (SELECT max(b.from_t_ns) FROM session_clocks AS b WHERE b.session_id = k.session_id AND b.from_t_ns <= k.t_ns),
  (SELECT min(b.from_t_ns) FROM session_clocks AS b WHERE b.session_id = k.session_id));
