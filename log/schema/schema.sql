-- Schema of a match log. One file holds one session or several merged ones.
-- Column names are those of the messages (idl/*.idl); _t_ns and t_ns are nanoseconds of the session's clock.
-- F: field frame, origin at the centre spot, +y to the opponents' goal, +x right. R: robot frame, +y forward, +x right.
-- A NULL in a number means that there is no such quantity. Labels are those of the IDL's enums, lower case without prefix;
-- with IN instead of OR, SQLite would build a table of more than two labels again for each row that is written.

CREATE TABLE texts (                       -- long texts, each stored once
  sha256 TEXT NOT NULL PRIMARY KEY,        -- of text, lower case hexadecimal
  text TEXT NOT NULL                       -- configuration, or definition of the messages
) STRICT, WITHOUT ROWID;

CREATE TABLE sessions (                    -- one recording
  session_id INTEGER NOT NULL PRIMARY KEY, -- first 63 bits of the uuid, key of every other table
  uuid TEXT NOT NULL UNIQUE,               -- version 4; of `trivela simulate`, version 8: made of the arguments
  robot_id INTEGER,                        -- robot that recorded; NULL: several
  started_t_ns INTEGER NOT NULL,           -- start of the recording
  closed_t_ns INTEGER,                     -- end of the recording; NULL: it was never finalised
  clock TEXT NOT NULL CHECK (clock IN ('steady', 'simulated')), -- clock of every t_ns
  realtime_offset_ns INTEGER NOT NULL,     -- UTC since 1970 minus this clock
  config_sha256 TEXT NOT NULL,             -- texts.sha256 of the whole configuration as it was used
  seed INTEGER,                            -- of the simulated match; NULL: no simulation
  software_version TEXT NOT NULL,          -- of the program that recorded
  scenario TEXT NOT NULL,                  -- name of the scenario or of the match
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)), -- 1: a simulated match
  idl_sha256 TEXT NOT NULL,                -- texts.sha256 of the messages' definition
  arm TEXT,                                -- of an experiment; NULL: none
  kicker_table TEXT,                       -- height tables of that arm: 'new' or 'old'
  match_id INTEGER,                        -- of the experiment: where it is the same, possessions are the same situations
  continues_uuid TEXT,                     -- session that this one goes on from after its recorder ended; NULL: none
  replays_uuid TEXT,                       -- session whose samples are played again; NULL: none
  paired_halves INTEGER NOT NULL CHECK (paired_halves IN (0, 1)), -- 1: simulated halves with the same possessions
  planned_s REAL,                          -- of the whole recording, by this clock; NULL: nobody said
  calibration_id INTEGER                   -- of the experiment: the evening whose robots played; NULL: none
) STRICT, WITHOUT ROWID;

CREATE INDEX sessions_match ON sessions (match_id, arm);

CREATE TABLE digests (                     -- made when a session ends, of all its rows but this one
  session_id INTEGER NOT NULL PRIMARY KEY, -- sessions.session_id
  row_count INTEGER NOT NULL,              -- rows that it covers
  sha256 TEXT NOT NULL                     -- of those rows (log/schema/row_digest.hpp), lower case hexadecimal
) STRICT, WITHOUT ROWID;

CREATE TABLE experiments (                 -- what `trivela simulate` was asked for; none in a recorded match
  arguments_sha256 TEXT NOT NULL PRIMARY KEY, -- of arguments: a file goes on with the same ones alone
  arguments TEXT NOT NULL,                 -- scenario, arms, seed and numbers, as text
  matches INTEGER NOT NULL,                -- of each arm, when it is finished
  matches_done INTEGER NOT NULL            -- so far; the file is whole where the two are equal
) STRICT, WITHOUT ROWID;

CREATE TABLE session_policies (            -- the policy in charge, by robot and half
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot; 0: every robot that has no row of its own
  half INTEGER NOT NULL,                   -- 1, 2
  policy TEXT NOT NULL CHECK (policy GLOB '[a-z]*' AND policy NOT GLOB '*[^a-z0-9_]*' AND length(policy) < 32), -- in charge of the kicks
  PRIMARY KEY (session_id, robot_id, half)
) STRICT, WITHOUT ROWID;

CREATE TABLE continued (                   -- the kicker driver's counters where the session ends that this one continues
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  orders_handled INTEGER NOT NULL,         -- last kicker_status.orders_handled there
  orders_refused INTEGER NOT NULL,         -- last kicker_status.orders_refused there
  PRIMARY KEY (session_id, robot_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE assignments (                 -- the policy in charge, by possession
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  half INTEGER NOT NULL,                   -- 1, 2
  possession_id INTEGER NOT NULL,          -- the robot's own count
  policy TEXT NOT NULL CHECK (policy GLOB '[a-z]*' AND policy NOT GLOB '*[^a-z0-9_]*' AND length(policy) < 32), -- in charge of the kicks
  probability REAL NOT NULL,               -- with which it was put in charge; 1: not at random
  t_ns INTEGER,                            -- first decision of the possession in play; NULL: not noted
  PRIMARY KEY (session_id, robot_id, half, possession_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE odometry (                    -- wheel odometry with the samples it was made from
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of the wheel sample
  wheel_0_radps REAL,                      -- raw sample, rad/s
  wheel_1_radps REAL,                      -- raw sample, rad/s
  wheel_2_radps REAL,                      -- raw sample, rad/s
  wheel_3_radps REAL,                      -- raw sample, rad/s; NULL: a robot of three wheels
  gyro_radps REAL,                         -- raw sample, rad/s
  vx_mps REAL NOT NULL,                    -- body twist in R, right, m/s
  vy_mps REAL NOT NULL,                    -- body twist in R, forward, m/s
  omega_radps REAL NOT NULL,               -- counter-clockwise, rad/s
  x_m REAL NOT NULL,                       -- integrated since the node started, in its start frame, m
  y_m REAL NOT NULL,                       -- integrated, m
  heading_rad REAL NOT NULL,               -- integrated, rad
  var_v_m2ps2 REAL NOT NULL,               -- variance of vx and of vy, m2/s2
  var_omega_rad2ps2 REAL NOT NULL,         -- variance of omega, rad2/s2
  var_position_m2 REAL NOT NULL,           -- variance of x and of y, m2
  var_heading_rad2 REAL NOT NULL,          -- variance of the heading, rad2
  obeyed TEXT NOT NULL CHECK (obeyed = 'nobody' OR obeyed = 'kick_decision' OR obeyed = 'team'), -- whose command the wheels have
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE vision_frames (               -- what the robot's vision saw in one frame
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- publication
  t_exposure_ns INTEGER NOT NULL,          -- instant the picture shows
  pose_seen INTEGER NOT NULL CHECK (pose_seen IN (0, 1)), -- 1: the robot located itself
  x_m REAL,                                -- self-localisation in F, m
  y_m REAL,                                -- self-localisation in F, m
  heading_rad REAL,                        -- self-localisation in F, rad
  ball_seen INTEGER NOT NULL CHECK (ball_seen IN (0, 1)), -- 1: the ball was seen
  ball_x_m REAL,                           -- ball centre in R, m
  ball_y_m REAL,                           -- ball centre in R, m
  opponent_seen INTEGER NOT NULL CHECK (opponent_seen IN (0, 1)), -- 1: an opponent was seen
  opponent_x_m REAL,                       -- nearest opponent in R, m
  opponent_y_m REAL,                       -- nearest opponent in R, m
  further_count INTEGER NOT NULL DEFAULT 0, -- further opponents that are seen, the keeper aside
  further_x_0_m REAL,                      -- of further opponent 0, in R, m
  further_x_1_m REAL,                      -- of further opponent 1, in R, m
  further_x_2_m REAL,                      -- of further opponent 2, in R, m
  further_x_3_m REAL,                      -- of further opponent 3, in R, m
  further_y_0_m REAL,                      -- of further opponent 0, in R, m
  further_y_1_m REAL,                      -- of further opponent 1, in R, m
  further_y_2_m REAL,                      -- of further opponent 2, in R, m
  further_y_3_m REAL,                      -- of further opponent 3, in R, m
  keeper_seen INTEGER NOT NULL CHECK (keeper_seen IN (0, 1)), -- 1: the opponents' keeper was seen
  keeper_x_m REAL,                         -- keeper in R, m
  keeper_y_m REAL,                         -- keeper in R, m
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE flight_frames (               -- one observation of the ball in flight
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- publication
  t_exposure_ns INTEGER NOT NULL,          -- instant the picture shows
  ball_seen INTEGER NOT NULL CHECK (ball_seen IN (0, 1)), -- 1: the ball was seen
  ball_x_m REAL,                           -- ball centre in F, m
  ball_y_m REAL,                           -- ball centre in F, m
  ball_z_m REAL,                           -- ball centre above the floor, m
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE referee (                     -- what the referee has said
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot that heard it
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of the word
  half INTEGER NOT NULL,                   -- 1, 2; 3, 4 in overtime
  playing INTEGER NOT NULL CHECK (playing IN (0, 1)), -- 0: everybody stands, no kick
  possession_id INTEGER NOT NULL,          -- numbers the ball possessions of a half; 0: not counted
  stage TEXT NOT NULL CHECK (stage = 'unknown' OR stage = 'pre_game' OR stage = 'first_half' OR stage = 'half_time'
    OR stage = 'second_half' OR stage = 'full_time' OR stage = 'first_overtime' OR stage = 'overtime_break'
    OR stage = 'second_overtime' OR stage = 'penalties' OR stage = 'game_over'), -- part of the match
  restart TEXT NOT NULL CHECK (restart = 'none' OR restart = 'kickoff' OR restart = 'freekick' OR restart = 'goalkick'
    OR restart = 'throwin' OR restart = 'corner' OR restart = 'penalty' OR restart = 'drop_ball'), -- announced for the next start
  ours INTEGER NOT NULL CHECK (ours IN (0, 1)), -- 1: the restart is our team's
  goals_own INTEGER NOT NULL,              -- counted since the writer started or the match was reset
  goals_other INTEGER NOT NULL,            -- the opponents'
  command_counter INTEGER NOT NULL,        -- rises with each command of the referee; 0: none yet, or not counted
  half_time_s REAL,                        -- since the first start of play in the half; NULL: none
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE world_states (                -- the robot's belief
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of validity
  half INTEGER NOT NULL,                   -- 1, 2
  playing INTEGER NOT NULL CHECK (playing IN (0, 1)), -- 1: the game runs
  possession_id INTEGER NOT NULL,          -- the robot's own count of its possessions in the half
  x_m REAL NOT NULL,                       -- pose in F, m
  y_m REAL NOT NULL,                       -- pose in F, m
  heading_rad REAL NOT NULL,               -- pose in F, rad
  vx_mps REAL NOT NULL,                    -- twist in R, right, m/s
  vy_mps REAL NOT NULL,                    -- twist in R, forward, m/s
  omega_radps REAL NOT NULL,               -- counter-clockwise, rad/s
  sd_position_m REAL NOT NULL,             -- standard deviation of x and of y, m
  sd_heading_rad REAL NOT NULL,            -- standard deviation of the heading, rad
  ball_known INTEGER NOT NULL CHECK (ball_known IN (0, 1)), -- 1: there is a belief of the ball
  ball_x_m REAL,                           -- ball centre in F, m
  ball_y_m REAL,                           -- ball centre in F, m
  ball_vx_mps REAL,                        -- ball velocity in F, m/s
  ball_vy_mps REAL,                        -- ball velocity in F, m/s
  ball_age_s REAL,                         -- since the ball was last seen, s
  possession INTEGER NOT NULL CHECK (possession IN (0, 1)), -- 1: the ball lies in the robot's handler
  opponent_distance_m REAL,                -- from the ball to the nearest opponent, m
  opponent_count INTEGER NOT NULL DEFAULT 0, -- opponents that are tracked, the keeper aside
  opponent_x_0_m REAL,                     -- of opponent 0: position in F, m
  opponent_x_1_m REAL,                     -- of opponent 1: position in F, m
  opponent_x_2_m REAL,                     -- of opponent 2: position in F, m
  opponent_x_3_m REAL,                     -- of opponent 3: position in F, m
  opponent_x_4_m REAL,                     -- of opponent 4: position in F, m
  opponent_y_0_m REAL,                     -- of opponent 0: position in F, m
  opponent_y_1_m REAL,                     -- of opponent 1: position in F, m
  opponent_y_2_m REAL,                     -- of opponent 2: position in F, m
  opponent_y_3_m REAL,                     -- of opponent 3: position in F, m
  opponent_y_4_m REAL,                     -- of opponent 4: position in F, m
  opponent_vx_0_mps REAL,                  -- of opponent 0: velocity in F, m/s
  opponent_vx_1_mps REAL,                  -- of opponent 1: velocity in F, m/s
  opponent_vx_2_mps REAL,                  -- of opponent 2: velocity in F, m/s
  opponent_vx_3_mps REAL,                  -- of opponent 3: velocity in F, m/s
  opponent_vx_4_mps REAL,                  -- of opponent 4: velocity in F, m/s
  opponent_vy_0_mps REAL,                  -- of opponent 0: velocity in F, m/s
  opponent_vy_1_mps REAL,                  -- of opponent 1: velocity in F, m/s
  opponent_vy_2_mps REAL,                  -- of opponent 2: velocity in F, m/s
  opponent_vy_3_mps REAL,                  -- of opponent 3: velocity in F, m/s
  opponent_vy_4_mps REAL,                  -- of opponent 4: velocity in F, m/s
  opponent_sd_0_m REAL,                    -- of opponent 0: standard deviation of its x and of its y, m
  opponent_sd_1_m REAL,                    -- of opponent 1: standard deviation of its x and of its y, m
  opponent_sd_2_m REAL,                    -- of opponent 2: standard deviation of its x and of its y, m
  opponent_sd_3_m REAL,                    -- of opponent 3: standard deviation of its x and of its y, m
  opponent_sd_4_m REAL,                    -- of opponent 4: standard deviation of its x and of its y, m
  opponent_sd_0_mps REAL,                  -- of opponent 0: standard deviation of its velocity, each axis, m/s
  opponent_sd_1_mps REAL,                  -- of opponent 1: standard deviation of its velocity, each axis, m/s
  opponent_sd_2_mps REAL,                  -- of opponent 2: standard deviation of its velocity, each axis, m/s
  opponent_sd_3_mps REAL,                  -- of opponent 3: standard deviation of its velocity, each axis, m/s
  opponent_sd_4_mps REAL,                  -- of opponent 4: standard deviation of its velocity, each axis, m/s
  keeper_x_m REAL,                         -- the opponents' keeper along their goal line, in F, m; NULL: none is tracked
  keeper_sd_m REAL,                        -- its standard deviation, m
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE drive_commands (              -- how the robot shall move until the next command
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- world state that it answers
  vx_mps REAL NOT NULL,                    -- in R, right, m/s
  vy_mps REAL NOT NULL,                    -- in R, forward, m/s
  omega_radps REAL NOT NULL,               -- counter-clockwise, rad/s
  lever_kind INTEGER NOT NULL DEFAULT 0,   -- kind of kick for which the kicker's lever shall stand
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE team_drives (                 -- how the team's own program wants the robot to move
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of the command
  vx_mps REAL NOT NULL,                    -- in R, right, m/s
  vy_mps REAL NOT NULL,                    -- in R, forward, m/s
  omega_radps REAL NOT NULL,               -- counter-clockwise, rad/s
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE kicker_status (               -- the state of the kicker
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of the device sample
  state TEXT NOT NULL CHECK (state = 'off' OR state = 'charging' OR state = 'ready' OR state = 'firing'
    OR state = 'cooling' OR state = 'fault'), -- of the driver
  charge REAL NOT NULL,                    -- capacitor energy, 0..1
  charge_modelled INTEGER NOT NULL CHECK (charge_modelled IN (0, 1)), -- 1: computed from the time since the last shot
  voltage_v REAL,                          -- of the capacitor, V; NULL: not measured
  armed INTEGER NOT NULL CHECK (armed IN (0, 1)), -- 1: switch on and game playing
  ready INTEGER NOT NULL CHECK (ready IN (0, 1)), -- 1: armed, charged, no fault, no kick under way
  fault TEXT NOT NULL CHECK (fault = 'none' OR fault = 'charger' OR fault = 'coil' OR fault = 'link'), -- of the device
  last_kick_id INTEGER NOT NULL,           -- last order answered; 0: none
  last_accepted INTEGER NOT NULL CHECK (last_accepted IN (0, 1)), -- 1: the last order was accepted
  orders_handled INTEGER NOT NULL,         -- orders so far
  orders_refused INTEGER NOT NULL,         -- refused orders so far
  lever_kind INTEGER NOT NULL DEFAULT 0,   -- kind of kick that the lever stands for; 255: it moves
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE kick_decisions (              -- one cycle with the ball: fire or hold, and every number behind it
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- world state that was judged
  kick_id INTEGER NOT NULL,                -- joins order, receipt, outcome and truth; 0: held
  half INTEGER NOT NULL,                   -- 1, 2
  possession_id INTEGER NOT NULL,          -- the robot's own count of its possessions in the half
  policy TEXT NOT NULL CHECK (policy GLOB '[a-z]*' AND policy NOT GLOB '*[^a-z0-9_]*' AND length(policy) < 32), -- in charge
  fire INTEGER NOT NULL CHECK (fire IN (0, 1)), -- 1: kick now
  reason TEXT NOT NULL CHECK (reason = 'fire' OR reason = 'not_playing' OR reason = 'no_ball'
    OR reason = 'kicker_not_ready' OR reason = 'order_pending' OR reason = 'approaching' OR reason = 'turning'
    OR reason = 'settling' OR reason = 'not_aligned' OR reason = 'out_of_range' OR reason = 'stale_state'
    OR reason = 'drive_finished' OR reason = 'unlikely' OR reason = 'waiting' OR reason = 'own_half'), -- why it fires or holds
  x_m REAL NOT NULL,                       -- robot pose in F, m
  y_m REAL NOT NULL,                       -- robot pose in F, m
  heading_rad REAL NOT NULL,               -- robot pose in F, rad
  vx_mps REAL NOT NULL,                    -- robot twist in R, right, m/s
  vy_mps REAL NOT NULL,                    -- robot twist in R, forward, m/s
  omega_radps REAL NOT NULL,               -- counter-clockwise, rad/s
  target_x_m REAL NOT NULL,                -- aim point in F, m
  target_y_m REAL NOT NULL,                -- aim point in F, m
  target_z_m REAL NOT NULL,                -- height of the ball centre over the goal line, m
  distance_m REAL NOT NULL,                -- ball centre to target, horizontal, m
  v0_mps REAL,                             -- exit speed for a robot at rest, m/s
  v_kick_mps REAL,                         -- exit speed asked of the kicker, m/s
  power REAL,                              -- set-point of the robot's own table
  alpha_rad REAL NOT NULL,                 -- deflection by the lateral velocity, right positive, rad
  beta_rad REAL NOT NULL,                  -- lead angle of the rotation, rad
  aligned INTEGER NOT NULL CHECK (aligned IN (0, 1)), -- 1: the two segments meet
  offset_right_m REAL,                     -- where S1 meets the target line, m
  left_m REAL NOT NULL,                    -- reach of S2 to the left of the target, m
  right_m REAL NOT NULL,                   -- reach of S2 to the right of the target, m
  predicted_x_cross_m REAL,                -- where the ball would cross the goal line, in F, m
  predicted_z_cross_m REAL,                -- height of that crossing, m
  predicted_t_flight_s REAL,               -- time of that flight, s
  p_on_target REAL,                        -- predicted probability that this kick is on target
  p_goal REAL,                             -- the same, and past the keeper; NULL: no keeper is tracked
  fire_after_s REAL NOT NULL,              -- coil energised so much after t_ns, s
  kick_kind INTEGER NOT NULL DEFAULT 0,    -- of the robot's kinds of kick, in the order of its file
  lever_kind INTEGER NOT NULL DEFAULT 0,   -- kind of kick for which the kicker's lever shall stand
  assignment_probability REAL NOT NULL,    -- with which the policy was put in charge; 1: not at random
  opponent_distance_m REAL,                -- from the ball to the nearest opponent, m
  charge REAL NOT NULL,                    -- capacitor energy, 0..1
  shadow_count INTEGER NOT NULL,           -- rows in shadow_decisions
  estimate INTEGER,                        -- kicker_estimates.seq of the kicker that it decided by; 0: the robot's file; NULL: not known
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE INDEX kick_decisions_fired ON kick_decisions (session_id, robot_id, kick_id, seq) WHERE fire = 1;

CREATE TABLE shadow_decisions (            -- what a policy that is not in charge would have done
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- kick_decisions.seq
  shadow_index INTEGER NOT NULL,           -- place among the decision's shadows, from 0
  policy TEXT NOT NULL CHECK (policy = 'stopped' OR policy = 'moving' OR policy = 'predictive'
    OR policy = 'learned'), -- not in charge
  fire INTEGER NOT NULL CHECK (fire IN (0, 1)), -- 1: it would kick now
  reason TEXT NOT NULL CHECK (reason = 'fire' OR reason = 'not_playing' OR reason = 'no_ball'
    OR reason = 'kicker_not_ready' OR reason = 'order_pending' OR reason = 'approaching' OR reason = 'turning'
    OR reason = 'settling' OR reason = 'not_aligned' OR reason = 'out_of_range' OR reason = 'stale_state'
    OR reason = 'drive_finished' OR reason = 'unlikely' OR reason = 'waiting' OR reason = 'own_half'), -- why it fires or holds
  power REAL,                              -- set-point of the robot's own table
  v_kick_mps REAL,                         -- exit speed asked of the kicker, m/s
  aligned INTEGER NOT NULL CHECK (aligned IN (0, 1)), -- 1: the two segments meet
  offset_right_m REAL,                     -- where S1 meets the target line, m
  left_m REAL,                             -- reach of S2 to the left of the target, m
  right_m REAL,                            -- reach of S2 to the right of the target, m
  p_on_target REAL,                        -- predicted probability that its kick is on target
  p_goal REAL,                             -- the same, and past the keeper; NULL: no keeper is tracked
  fire_after_s REAL NOT NULL,              -- coil energised so much after t_ns, s
  kick_kind INTEGER NOT NULL DEFAULT 0,    -- of the robot's kinds of kick, in the order of its file
  PRIMARY KEY (session_id, robot_id, seq, shadow_index)
) STRICT, WITHOUT ROWID;

CREATE TABLE kick_orders (                 -- the command to kick
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- world state that was judged
  kick_id INTEGER NOT NULL,                -- of the decision
  power REAL NOT NULL,                     -- set-point of the robot's own table
  fire_t_ns INTEGER NOT NULL,              -- earliest instant to energise the coil
  valid_until_t_ns INTEGER NOT NULL,       -- afterwards the driver refuses it
  possession INTEGER NOT NULL CHECK (possession IN (0, 1)), -- 1: the ball lay in the handler in the world state
  kick_kind INTEGER NOT NULL DEFAULT 0,    -- of the robot's kinds of kick, in the order of its file
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE INDEX kick_orders_kick ON kick_orders (session_id, robot_id, kick_id);

CREATE TABLE kick_receipts (               -- the driver's answer to an order
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- instant of the answer
  kick_id INTEGER NOT NULL,                -- of the order
  accepted INTEGER NOT NULL CHECK (accepted IN (0, 1)), -- 1: the device was told, or may have been
  refusal TEXT NOT NULL CHECK (refusal = 'none' OR refusal = 'stale' OR refusal = 'out_of_range'
    OR refusal = 'unarmed' OR refusal = 'double' OR refusal = 'charging' OR refusal = 'fault'
    OR refusal = 'referee_silent' OR refusal = 'no_ball' OR refusal = 'unauthorised' OR refusal = 'not_known'
    OR refusal = 'lever'), -- why it was refused; not_known: accepted, and nobody knows whether it fired
  order_t_ns INTEGER NOT NULL,             -- t_ns of the order
  fired_t_ns INTEGER NOT NULL,             -- coil energised; 0: refused
  release_t_ns INTEGER NOT NULL,           -- expected release of the ball; 0: refused
  power REAL NOT NULL,                     -- set-point given to the device
  kick_kind INTEGER NOT NULL DEFAULT 0,    -- of the robot's kinds of kick, in the order of its file
  received_steady_ns INTEGER NOT NULL,     -- steady clock: the order was taken; 0: lockstep
  fired_steady_ns INTEGER NOT NULL,        -- steady clock: the device was told; 0: refused, or lockstep
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE INDEX kick_receipts_kick ON kick_receipts (session_id, robot_id, kick_id);

CREATE TABLE kick_outcomes (               -- what became of a kick, as seen by the robot; the latest seq of a kick holds
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- exposure that settled it
  kick_id INTEGER NOT NULL,                -- of the order
  outcome TEXT NOT NULL CHECK (outcome = 'on_target' OR outcome = 'wide_left' OR outcome = 'wide_right'
    OR outcome = 'over' OR outcome = 'short' OR outcome = 'post' OR outcome = 'bar' OR outcome = 'blocked'
    OR outcome = 'unknown'), -- on_target: between the posts and below the bar, saves included
  on_target INTEGER NOT NULL CHECK (on_target IN (0, 1)), -- 1: between the posts and below the bar
  x_cross_m REAL,                          -- ball centre at the goal line, in F, m
  z_cross_m REAL,                          -- ball centre at the goal line, m
  sd_cross_m REAL,                         -- standard deviation of x_cross_m and z_cross_m, m
  observations INTEGER NOT NULL,           -- frames with the ball behind it
  exit_speed_mps REAL,                     -- of the observed flight, over ground, m/s
  exit_elevation_rad REAL,                 -- of the observed flight, rad
  flight_speed_mps REAL,                   -- exit speed of the drag-free parabola through the whole flight, m/s
  flight_elevation_rad REAL,               -- of that parabola where it leaves the floor, rad
  flight_direction_rad REAL,               -- of that parabola, as a heading in F, rad
  flight_sd_mps REAL,                      -- standard deviation of a component of its velocity, m/s
  p_on_target REAL,                        -- probability of on_target in the light of the sightings; NULL: not computed
  p_wide_left REAL,                        -- the same of wide_left
  p_wide_right REAL,                       -- of wide_right
  p_over REAL,                             -- of over
  p_short REAL,                            -- of short
  p_post REAL,                             -- of post
  p_bar REAL,                              -- of bar
  p_blocked REAL,                          -- of blocked
  bounced INTEGER CHECK (bounced IN (0, 1)), -- 1: it touched the floor before the line; NULL: not said
  residual_sd_m REAL,                      -- of a sighting about the fit, m
  release_late_s REAL,                     -- by its flight the ball left so much later than the robot's file says, s
  p_saved REAL,                            -- probability that it was on target and a keeper stopped it; NULL: not known
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE INDEX kick_outcomes_kick ON kick_outcomes (session_id, robot_id, kick_id);

CREATE TABLE kicker_estimates (            -- what the kicks seen so far say of the kicker, to be added to its file
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  seq INTEGER NOT NULL,                    -- sequence number of the stream; 1: before the first kick
  t_ns INTEGER NOT NULL,                   -- cycle of the frame that settled the kick; decisions of later cycles use it
  kick_id INTEGER NOT NULL,                -- of the kick that changed it; 0: none yet
  kicks INTEGER NOT NULL,                  -- that it has learned from
  used INTEGER NOT NULL CHECK (used IN (0, 1)), -- 1: decisions go by it
  speed_ln REAL NOT NULL,                  -- ln of the exit speed by that of the file
  elevation_rad REAL NOT NULL,             -- exit angle, rad
  direction_rad REAL NOT NULL,             -- of the kick from the robot's heading, left positive, rad
  delay_s REAL NOT NULL,                   -- from order to release, s
  along_ratio REAL NOT NULL,               -- transfer forward and backward
  sideways_ratio REAL NOT NULL,            -- transfer sideways
  speed_ln_se REAL NOT NULL,               -- standard error of speed_ln
  elevation_se_rad REAL NOT NULL,          -- standard error, rad
  direction_se_rad REAL NOT NULL,          -- standard error, rad
  delay_se_s REAL NOT NULL,                -- standard error, s
  along_se_ratio REAL NOT NULL,            -- standard error
  sideways_se_ratio REAL NOT NULL,         -- standard error
  speed_sd_ratio REAL NOT NULL,            -- exit speed from kick to kick, standard deviation
  elevation_sd_rad REAL NOT NULL,          -- elevation from kick to kick, standard deviation, rad
  direction_sd_rad REAL NOT NULL,          -- direction from kick to kick, standard deviation, rad
  delay_sd_s REAL NOT NULL,                -- delay from kick to kick, standard deviation, s
  p_mistaken REAL NOT NULL,                -- probability that the sightings of the last kick say nothing of the kicker
  p_jump REAL NOT NULL,                    -- probability that the kicker changed at the last kick
  chi_square REAL NOT NULL,                -- of the last flight's four residuals; 4 on average where all of this is right
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE kick_truths (                 -- the simulator's truth of a kick; no robot ever sees it
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot that kicked
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- simulator's truth: instant that settled it
  kick_id INTEGER NOT NULL,                -- of the order
  half INTEGER NOT NULL,                   -- 1, 2
  possession_id INTEGER NOT NULL,          -- numbers the ball possessions of a half
  outcome TEXT NOT NULL CHECK (outcome = 'on_target' OR outcome = 'wide_left' OR outcome = 'wide_right'
    OR outcome = 'over' OR outcome = 'short' OR outcome = 'post' OR outcome = 'bar' OR outcome = 'blocked'
    OR outcome = 'unknown'), -- simulator's truth
  x_cross_m REAL,                          -- simulator's truth: ball centre at the goal line, in F, m
  z_cross_m REAL,                          -- simulator's truth: ball centre at the goal line, m
  release_t_ns INTEGER NOT NULL,           -- simulator's truth: the ball left the kicker
  release_x_m REAL NOT NULL,               -- simulator's truth: ball centre at release, in F, m
  release_y_m REAL NOT NULL,               -- simulator's truth: ball centre at release, in F, m
  release_vx_mps REAL NOT NULL,            -- simulator's truth: ball velocity at release, in F, m/s
  release_vy_mps REAL NOT NULL,            -- simulator's truth: ball velocity at release, in F, m/s
  release_vz_mps REAL NOT NULL,            -- simulator's truth: ball velocity at release, upwards, m/s
  margin_m REAL,                           -- simulator's truth: crossing to the nearest edge of another outcome, m
  saved INTEGER NOT NULL CHECK (saved IN (0, 1)), -- simulator's truth: on target, but the keeper had it
  bounced INTEGER CHECK (bounced IN (0, 1)), -- simulator's truth: it touched the floor before the line; NULL: not said
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE INDEX kick_truths_kick ON kick_truths (session_id, robot_id, kick_id);

CREATE TABLE possession_truths (           -- the simulator's truth of how a ball possession ended; no robot ever sees it
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot that had the ball
  seq INTEGER NOT NULL,                    -- sequence number of the stream
  t_ns INTEGER NOT NULL,                   -- simulator's truth: end of the possession
  half INTEGER NOT NULL,                   -- 1, 2
  possession_id INTEGER NOT NULL,          -- numbers the ball possessions of a half
  ending TEXT NOT NULL CHECK (ending = 'kicked' OR ending = 'disputed' OR ending = 'timed_out'
    OR ending = 'stopped'), -- simulator's truth
  start_t_ns INTEGER NOT NULL,             -- simulator's truth: the possession began
  start_x_m REAL NOT NULL,                 -- simulator's truth: robot pose in F at the start, m
  start_y_m REAL NOT NULL,                 -- simulator's truth: robot pose in F at the start, m
  start_heading_rad REAL NOT NULL,         -- simulator's truth: robot pose in F at the start, rad
  PRIMARY KEY (session_id, robot_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE losses (                      -- what the recording missed: a row of counters a stream, and one a silence
  session_id INTEGER NOT NULL,             -- sessions.session_id
  stream TEXT NOT NULL,                    -- name of the table that the samples were for
  robot_id INTEGER NOT NULL,               -- robot whose samples stayed away; 0: the counters, of all robots
  from_t_ns INTEGER NOT NULL,              -- last sample before the silence; of the counters: start of the recording
  to_t_ns INTEGER,                         -- first sample after it, NULL: none came; of the counters: latest sample
  received INTEGER NOT NULL,               -- rows handed to the log, refused ones included
  lost INTEGER NOT NULL,                   -- samples that the bus reported as lost
  gaps INTEGER NOT NULL,                   -- sequence numbers that never arrived
  overflow INTEGER NOT NULL,               -- rows that found the log's queue full
  nan_refused INTEGER NOT NULL,            -- rows with NaN, infinity or NULL where a number must be
  rejected INTEGER NOT NULL,               -- rows against the schema: unknown label, wrong type, same key twice
  out_of_order INTEGER NOT NULL,           -- samples older than their predecessor
  PRIMARY KEY (session_id, stream, robot_id, from_t_ns)
) STRICT, WITHOUT ROWID;

CREATE TABLE clock_offsets (               -- how far another participant's clock is ahead of that of who measured
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot that measured; 0: the base
  other_robot_id INTEGER NOT NULL,         -- robot whose clock was measured; 0: the base
  t_ns INTEGER NOT NULL,                   -- instant of the measurement, by the clock of who measured
  offset_ns INTEGER NOT NULL,              -- the other's clock minus this one
  error_ns INTEGER NOT NULL,               -- the offset is known to plus and minus so much
  PRIMARY KEY (session_id, robot_id, other_robot_id, t_ns)
) STRICT, WITHOUT ROWID;

CREATE TABLE session_clocks (              -- made by merging: UTC by the reference's clock; no row: by realtime_offset_ns
  session_id INTEGER NOT NULL,             -- sessions.session_id
  from_t_ns INTEGER NOT NULL,              -- by the session's clock; a row holds up to the next
  utc_offset_ns INTEGER NOT NULL,          -- UTC since 1970 by the reference's clock minus this clock, at from_t_ns
  rate REAL NOT NULL,                      -- and so much more a nanosecond after it
  error_ns INTEGER NOT NULL,               -- known to plus and minus so much, from here to the next row
  reference_uuid TEXT NOT NULL,            -- sessions.uuid of a recording by the reference's clock
  PRIMARY KEY (session_id, from_t_ns)
) STRICT, WITHOUT ROWID;

CREATE TABLE merged_sessions (             -- made by merging: the files that had a session, or a part of it
  session_id INTEGER NOT NULL,             -- sessions.session_id
  file TEXT NOT NULL,                      -- name of the file, without its folder
  row_count INTEGER NOT NULL,              -- rows of the session that could be read there
  damage TEXT NOT NULL,                    -- what was wrong with the file; empty: nothing
  PRIMARY KEY (session_id, file)
) STRICT, WITHOUT ROWID;

CREATE TABLE labels (                      -- what people say of a kick; every row stays, the latest of a kick holds
  session_id INTEGER NOT NULL,             -- sessions.session_id in which it was labelled
  robot_id INTEGER NOT NULL,               -- robot that kicked
  kick_id INTEGER NOT NULL,                -- of the decision
  utc_ns INTEGER NOT NULL,                 -- UTC since 1970, later than the kick's other labels
  who TEXT NOT NULL,                       -- who says so
  t_ns INTEGER NOT NULL,                   -- of the decision: with robot and kick_id it names the kick in other recordings
  outcome TEXT CHECK (outcome = 'goal' OR outcome = 'saved' OR outcome = 'on_target' OR outcome = 'wide_left'
    OR outcome = 'wide_right' OR outcome = 'over' OR outcome = 'short' OR outcome = 'post' OR outcome = 'bar'
    OR outcome = 'blocked' OR outcome = 'outside' OR outcome = 'unknown'), -- what became of it; on_target: goal or saved;
                                           -- outside: it does not say how; NULL: withdrawn
  note TEXT NOT NULL,                      -- why, such as a video's time; empty: none
  PRIMARY KEY (session_id, robot_id, kick_id, utc_ns, who)
) STRICT, WITHOUT ROWID;

CREATE INDEX labels_kick ON labels (robot_id, kick_id);

CREATE TABLE notes (                       -- what people say of a session; every row stays
  session_id INTEGER NOT NULL,             -- sessions.session_id
  kind TEXT NOT NULL CHECK (kind = 'match' OR kind = 'opponent' OR kind = 'venue'
    OR kind = 'note'), -- of match, opponent and venue the latest holds, notes stand beside each other
  utc_ns INTEGER NOT NULL,                 -- UTC since 1970
  who TEXT NOT NULL,                       -- who says so
  text TEXT,                               -- NULL: what was said of this kind before is withdrawn
  PRIMARY KEY (session_id, kind, utc_ns, who)
) STRICT, WITHOUT ROWID;

CREATE TABLE session_tallies (             -- decisions counted when a session ends; tallied_sessions says of which
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  policy TEXT NOT NULL,                    -- that decided
  in_charge INTEGER NOT NULL CHECK (in_charge IN (0, 1)), -- 1: rows of kick_decisions; 0: of shadow_decisions
  decisions INTEGER NOT NULL,              -- rows
  fires INTEGER NOT NULL,                  -- of them with fire = 1
  first_t_ns INTEGER NOT NULL,             -- of the first decision
  last_t_ns INTEGER NOT NULL,              -- of the last one
  possessions INTEGER NOT NULL,            -- that it decided in: different half and possession_id of the decisions
  PRIMARY KEY (session_id, robot_id, policy, in_charge)
) STRICT, WITHOUT ROWID;

CREATE TABLE possession_tallies (          -- possessions counted when a session ends
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot; of the referee's count the one that received it
  half INTEGER NOT NULL,                   -- 1, 2
  possession_id INTEGER NOT NULL,          -- by the count of counted_by
  counted_by TEXT NOT NULL CHECK (counted_by = 'robot' OR counted_by = 'referee'), -- whose count it is
  first_seq INTEGER,                       -- kick_decisions.seq of the first decision; NULL: none, or the referee's count
  decisions INTEGER NOT NULL,              -- rows of kick_decisions; 0 of the referee's count
  fires INTEGER NOT NULL,                  -- of them with fire = 1
  from_t_ns INTEGER,                       -- play by this count (evaluator/metrics/played_spans.sql); NULL: none
  to_t_ns INTEGER,                         -- its end
  played_ns INTEGER,                       -- played between the two
  PRIMARY KEY (session_id, robot_id, half, possession_id, counted_by)
) STRICT, WITHOUT ROWID;

CREATE TABLE order_tallies (               -- kicker_status counted when a session ends
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot
  first_t_ns INTEGER NOT NULL,             -- of the first status
  first_handled INTEGER NOT NULL,          -- orders_handled there
  first_refused INTEGER NOT NULL,          -- orders_refused there
  handled_within INTEGER NOT NULL,         -- orders from there to the last status, a driver that starts again counting from 0
  refused_within INTEGER NOT NULL,         -- of them refused
  PRIMARY KEY (session_id, robot_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE referee_tallies (             -- the referee's words counted when a session ends
  session_id INTEGER NOT NULL,             -- sessions.session_id
  robot_id INTEGER NOT NULL,               -- robot that heard them
  half INTEGER NOT NULL,                   -- 1, 2; 3, 4 in overtime
  words INTEGER NOT NULL,                  -- rows of referee
  first_t_ns INTEGER NOT NULL,             -- of the first one
  last_t_ns INTEGER NOT NULL,              -- of the last one
  PRIMARY KEY (session_id, robot_id, half)
) STRICT, WITHOUT ROWID;

CREATE TABLE ball_turns (                  -- balls that came back after a kick (log/file/session_tallies.hpp), when a session ends
  session_id INTEGER NOT NULL,             -- sessions.session_id
  turn INTEGER NOT NULL,                   -- from 0, in the order of time
  y_m REAL NOT NULL,                       -- how far forward it came, in F, m
  PRIMARY KEY (session_id, turn)
) STRICT, WITHOUT ROWID;

CREATE TABLE tallied_sessions (            -- sessions that were counted when they ended, after all of their tallies
  session_id INTEGER NOT NULL PRIMARY KEY, -- sessions.session_id
  sha256 TEXT NOT NULL                     -- digests.sha256 of the rows that were counted: of others the tallies say nothing
) STRICT, WITHOUT ROWID;

-- A kick is a decision that fired; an order may be sent twice, so the latest receipt that is no answer to a repetition
-- holds: an accepted order whose instant lay ahead may have been withdrawn.
-- INDEXED BY: without it the planner, misled by a short log, may walk through all decisions for each kick.
CREATE VIEW kicks AS
SELECT
  d.session_id, d.robot_id, d.seq, d.kick_id, d.t_ns, d.half, d.possession_id, d.policy,
  d.distance_m, d.power, d.kick_kind, d.v_kick_mps, d.p_on_target, d.predicted_x_cross_m, d.predicted_z_cross_m,
  o.seq AS order_seq,
  r.accepted, r.refusal, r.fired_t_ns, r.release_t_ns,
  c.outcome, c.on_target, c.x_cross_m, c.z_cross_m, c.sd_cross_m, c.exit_speed_mps,
  c.observations, c.p_on_target AS observed_p_on_target, c.p_saved AS observed_p_saved, c.bounced,
  t.outcome AS truth_outcome, t.x_cross_m AS truth_x_cross_m, t.z_cross_m AS truth_z_cross_m,
  t.margin_m AS truth_margin_m, t.saved AS truth_saved, t.bounced AS truth_bounced
FROM kick_decisions AS d
LEFT JOIN kick_orders AS o ON o.session_id = d.session_id AND o.robot_id = d.robot_id AND o.seq = (
  SELECT max(seq) FROM kick_orders INDEXED BY kick_orders_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
LEFT JOIN kick_receipts AS r ON r.session_id = d.session_id AND r.robot_id = d.robot_id AND r.seq = (
  SELECT seq FROM kick_receipts INDEXED BY kick_receipts_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id
  ORDER BY refusal = 'double', seq DESC LIMIT 1)
LEFT JOIN kick_outcomes AS c ON c.session_id = d.session_id AND c.robot_id = d.robot_id AND c.seq = (
  SELECT max(seq) FROM kick_outcomes INDEXED BY kick_outcomes_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
LEFT JOIN kick_truths AS t ON t.session_id = d.session_id AND t.robot_id = d.robot_id AND t.seq = (
  SELECT max(seq) FROM kick_truths INDEXED BY kick_truths_kick
  WHERE session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id)
WHERE d.fire = 1 AND d.seq = (
  SELECT min(seq) FROM kick_decisions INDEXED BY kick_decisions_fired
  WHERE fire = 1 AND session_id = d.session_id AND robot_id = d.robot_id AND kick_id = d.kick_id);
