-- Schema of a scan record, version 2. One file holds one session of one scanner.
-- t_ns are nanoseconds of the session's clock. x is along the kick from the ball's centre at the launch, z over the floor.

CREATE TABLE sessions (                    -- the recording, one row
  session_id INTEGER NOT NULL PRIMARY KEY, -- first 63 bits of the uuid, in every other table
  uuid TEXT NOT NULL UNIQUE,               -- version 4
  started_t_ns INTEGER NOT NULL,           -- start of the recording
  closed_t_ns INTEGER,                     -- end of the recording; NULL: it was never finalised
  realtime_offset_ns INTEGER NOT NULL,     -- UTC since 1970 minus this clock
  vendor TEXT NOT NULL,                    -- of the scanner, as it says itself
  product TEXT NOT NULL,                   -- of the scanner
  serial TEXT NOT NULL,                    -- of the scanner
  firmware TEXT NOT NULL,                  -- of the scanner
  protocol TEXT NOT NULL,                  -- of the scanner
  beams INTEGER NOT NULL CHECK (beams > 0), -- ranges in a scan
  first_angle_rad REAL NOT NULL,           -- of beam 0 in the scanner's plane, counter-clockwise, 0: its front, rad
  step_rad REAL NOT NULL,                  -- from beam to beam, rad
  beam_period_s REAL NOT NULL,             -- from beam to beam, s
  scan_period_s REAL NOT NULL,             -- start of one scan to start of the next, s
  min_range_m REAL NOT NULL,               -- least range that is measured, m
  max_range_m REAL NOT NULL,               -- largest range that is measured, m
  laser_x_m REAL NOT NULL,                 -- where the scanner stands, m
  laser_z_m REAL NOT NULL,                 -- where the scanner stands, m
  front_elevation_rad REAL NOT NULL,       -- of the scanner's front, from +x over +z, rad
  mirrored INTEGER NOT NULL CHECK (mirrored IN (0, 1)), -- 1: the scanner lies on its other side
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)), -- 1: synthetic scans
  source TEXT NOT NULL,                    -- address of the device, or what made the scans
  software_version TEXT NOT NULL           -- of the program that recorded
) STRICT, WITHOUT ROWID;

CREATE TABLE scans (                       -- one revolution of the scanner
  session_id INTEGER NOT NULL,             -- sessions.session_id
  seq INTEGER NOT NULL PRIMARY KEY,        -- counts the scans recorded, from 0
  t_ns INTEGER NOT NULL,                   -- instant of beam 0
  ranges BLOB NOT NULL                     -- mm as the device gave them: per beam the difference to the beam before (to 0 for
                                           -- the first), zigzag, as a variable-length integer of 7 bits a byte, low first
) STRICT;

CREATE TABLE set_points (                  -- the power of the kicks from t_ns on
  session_id INTEGER NOT NULL,             -- sessions.session_id
  seq INTEGER NOT NULL,                    -- counts them, from 0
  t_ns INTEGER NOT NULL,                   -- kicks launched from then on
  power REAL NOT NULL,                     -- set-point of the robot's own table; 0: of none, as after a plan's end
  kick_id INTEGER NOT NULL,                -- of the order; 0: entered by hand
  PRIMARY KEY (session_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE verdicts (                    -- what a human said of a lob; the last word counts
  session_id INTEGER NOT NULL,             -- sessions.session_id
  seq INTEGER NOT NULL,                    -- counts them, from 0
  launch_t_ns INTEGER NOT NULL,            -- launch of the lob
  accepted INTEGER NOT NULL CHECK (accepted IN (0, 1)), -- 0: rejected
  why TEXT NOT NULL,                       -- the reason, may be empty
  PRIMARY KEY (session_id, seq)
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
