-- Schema of study results, version 1: what the arms of a study did in each match, and nothing else of it.

CREATE TABLE studies (                     -- what the verb was asked for: one row
  arguments_sha256 TEXT NOT NULL PRIMARY KEY, -- of arguments: a file goes on with the same ones alone
  arguments TEXT NOT NULL,                 -- everything that its rows depend on, as text
  matches INTEGER NOT NULL,                -- of each arm, when it is finished
  finished INTEGER NOT NULL CHECK (finished IN (0, 1)) -- 1: what was asked for is there
) STRICT, WITHOUT ROWID;

CREATE TABLE arms (                        -- who played
  arm_id INTEGER NOT NULL PRIMARY KEY,     -- first 63 bits of sha256
  sha256 TEXT NOT NULL,                    -- of all that its matches depend on but their number
  place INTEGER NOT NULL,                  -- from 0, in the order in which they were asked for
  name TEXT NOT NULL                       -- for people
) STRICT, WITHOUT ROWID;

CREATE TABLE tallies (                     -- what an arm did in a match
  arm_id INTEGER NOT NULL,                 -- arms.arm_id
  match_id INTEGER NOT NULL,               -- where it is the same, opportunities are the same situations
  calibration_id INTEGER NOT NULL,         -- evening of calibration whose robots played
  opportunities INTEGER NOT NULL,          -- gains of the ball
  kicks INTEGER NOT NULL,                  -- accepted by the driver
  on_target INTEGER NOT NULL,              -- observed
  blocked INTEGER NOT NULL,                -- observed
  bounced INTEGER NOT NULL,                -- on target, and by the simulator's truth it touched the floor before
  goals INTEGER NOT NULL,                  -- by the simulator's truth: on target and past the keeper
  true_on_target INTEGER NOT NULL,         -- by the simulator's truth
  PRIMARY KEY (arm_id, match_id)
) STRICT, WITHOUT ROWID;
