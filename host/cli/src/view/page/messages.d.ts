// Messages between the program and the page, by the names of their structs in host/cli/src/view/lines.rs,
// host/cli/src/folding.rs, host/cli/src/on_robot/lines.rs, host/taxel/src/json/lines
// and host/taxel/src/mind/line.rs. Made from these by host/cli/tests/program/page_types.rs:
// TAXEL_BLESS=1 updates it.

/** Garment, scene and firmware of the board, and how the page shows them. */
export type PageHello = {
  /** Type of the message. */
  type: "hello";
  /** The board's time, us. */
  time_us: number;
  /** Name and version of the firmware. */
  firmware: string;
  /** Unique id of the board's chip; empty if it has none, as a simulated board. */
  chip: string;
  /** True of a simulated board. */
  simulated: boolean;
  /** Name of the garment. */
  garment: string;
  /** Name of the scene. */
  scene: string;
  /** Id, date and fit of the calibration in force; empty without one: values are counts. */
  calibration: string;
  /** Start of the board; null if it does not know it. */
  boot: {
    /** `power`, `pin`, `watchdog`, `panic`, `request` or `other`. */
    cause: string;
    /** Resets by watchdog or panic up to this one, each less than a minute after the one before. */
    resets: number;
    /** Reason why the stored settings are not in use: `no` (they are), `resets`, `pin` or `request`. */
    aside: string;
  } | null;
  /** Number of taxels. */
  taxels: number;
  /** Names of the regions of the body. */
  regions: string[];
  /** The panels, in the order of their taxels. */
  panels: {
    /** Name of the panel. */
    name: string;
    /** Link of the robot. */
    link: string;
    /** Region of the body. */
    region: string;
    /** Number of rows. */
    rows: number;
    /** Number of columns. */
    columns: number;
    /** Distance of columns and of rows, um; 0 if unknown. */
    pitch_um: [number, number];
  }[];
  /** The source. */
  label: string;
  /** Colours and scale. */
  palette: {
    /** Red, green and blue of each step. */
    ramp: [number, number, number][];
    /** Number of equal parts of the scale. */
    bands: number;
    /** End of the scale at the beginning, counts. */
    start: number;
    /** Least and greatest end of the scale, counts. */
    ends: [number, number];
    /** Colour of each intention, `#rrggbb`. */
    intentions: Record<string, string>;
    /** Colour of feelings, `#rrggbb`. */
    feeling: string;
  };
  /** Counts per newton on a taxel; null if unknown. */
  counts_per_newton: number | null;
  /** Basis of forces: `calibrated`, `nominal` or `simulated`; null if they are in counts. */
  force_basis: string | null;
  /** Counts at which a contact ends. */
  low: number;
  /** Rectangles of positions without a taxel. */
  absent: {
    /** Index of the panel. */
    panel: number;
    /** First row. */
    row: number;
    /** First column. */
    column: number;
    /** Number of rows. */
    rows: number;
    /** Number of columns. */
    columns: number;
  }[];
  /** The cognitive map; null if the scene has none. */
  map: {
    /** The concepts. */
    concepts: {
      /** Name of the concept. */
      name: string;
      /** Layer in the drawing, from 0. */
      layer: number;
      /** Part of the concept: `felt`, `meaning` or `feeling`. */
      role: string;
    }[];
    /** The edges whose weight is not 0. */
    edges: {
      /** Index of the cause. */
      from: number;
      /** Index of the effect. */
      to: number;
      /** Weight, -1 to 1. */
      weight: number;
    }[];
  } | null;
};

/** Counters of the board, from its start on. */
export type HealthLine = {
  /** Type of the message. */
  type: "health";
  /** Duration of the last perception, us. */
  process_us: number;
  /** Finished scans. */
  scans: number;
  /** Scans that failed. */
  failed: number;
  /** Complete frames that were never read. */
  overruns: number;
  /** Images that were due and not sent, because the link had no room. */
  thinned_frames: number;
  /** Contact updates that were due and not sent. */
  thinned_contacts: number;
  /** Guaranteed messages that did not fit in the queue. */
  lost: number;
  /** Received frames that were refused. */
  refused: number;
  /** Duration of the last scan, us. */
  scan_us: number;
  /** The board's time, us. */
  time_us: number;
};

/** Faulty taxels. */
export type HealthMapLine = {
  /** Type of the message. */
  type: "health_map";
  /** The board's time, us. */
  time_us: number;
  /** True if the list is complete; else more follows. */
  whole: boolean;
  /** The faulty taxels, ascending. */
  faulty: {
    /** Number of the taxel. */
    taxel: number;
    /** Fault, for people. */
    health: string;
  }[];
};

/** Time spent on frames: of each part, the most that any of the frames took. */
export type BudgetLine = {
  /** Type of the message. */
  type: "budget";
  /** Number of the last of these scans. */
  frame: number;
  /** Images that were due and not sent, because the link had no room. */
  thinned_frames: number;
  /** Number of frames: 1, or all since the last such message. */
  frames: number;
  /** Duration of the scan, us. */
  scan_us: number;
  /** Time from the codes to the reactions, us. */
  process_us: number;
  /** Time of encoding messages and handing them to the link, us. */
  encode_us: number;
  /** Time for which a message waited for room on the link, us. */
  send_us: number;
  /** Complete frames that were never read. */
  overruns: number;
  /** Start of the last scan, us of the board. */
  time_us: number;
};

/** The link to the board is lost, and waited for. What was present has ended just before. */
export type LostLine = {
  /** Type of the message. */
  type: "lost";
  /** Host time at which the board was last heard, us since 1970. */
  since_us: number;
  /** The reason, for people. */
  why: string;
};

/** Head of a binary message. */
export type ImageHead = {
  /** Line of the image. */
  frame: {
    /** Type of the message. */
    type: "frame";
    /** Number of the scan. */
    frame: number;
    /** Start of the scan, us of the board. */
    time_us: number;
    /** Present contacts. */
    contacts: {
      /** Number of the contact, unique since the board's start. */
      id: number;
      /** `onset`, `held` or `released`. */
      phase: string;
      /** Index of the panel. */
      panel: number;
      /** Name of the panel. */
      panel_name: string;
      /** Region of the body. */
      region: string;
      /** Link of the robot. */
      link: string;
      /** Sum of the pressure of its taxels, counts. */
      total: number;
      /** Greatest pressure of a taxel, counts. */
      peak: number;
      /** Row of that taxel, from 0. */
      peak_row: number;
      /** Column of that taxel, from 0. */
      peak_column: number;
      /** Number of taxels. */
      area: number;
      /** Number of taxels at its edge. */
      perimeter: number;
      /** Mean slope over those taxels, counts per taxel. */
      edge: number;
      /** Centroid along the columns, taxels from the first column. */
      column: number;
      /** Centroid along the rows, taxels from the first row. */
      row: number;
      /** Centroid along the columns, mm from the first column; absent if the pitch is unknown. */
      x_mm?: number | null;
      /** Centroid along the rows, mm from the first row; absent if the pitch is unknown. */
      y_mm?: number | null;
      /** Direction of the long axis, rad; null if there is no clear direction. */
      azimuth_rad: number | null;
      /** Elongation, 0 (round) to 1 (a line). */
      anisotropy: number;
      /** Width across the long axis, mm. */
      breadth_mm: number;
      /** Normalised moment of inertia; depends on the pressure. */
      nmi: number;
      /** `nmi` times the root of the peak. */
      nmi_peak: number;
      /** `nmi` times the root of the mean pressure, weighted by the pressure itself. */
      nmi_s2: number;
      /** Name of the shape, or `unknown`. */
      shape: string;
      /** Share of the votes for that shape, 0 to 1; of an unknown shape, how far it is from all known ones. */
      confidence: number;
      /** Displacement along the columns since the onset, taxels. */
      moved_columns: number;
      /** Displacement along the rows since the onset, taxels. */
      moved_rows: number;
      /** Velocity along the columns, taxels/s. */
      columns_per_s: number;
      /** Velocity along the rows, taxels/s. */
      rows_per_s: number;
      /** True if it slides over the surface. */
      slip: boolean;
      /** True if all of it may be drift of the baseline. */
      unsure: boolean;
      /** Time since the onset, ms. */
      duration_ms: number;
      /** Greatest total so far, counts. */
      peak_total: number;
      /** Width at the greatest total, mm. */
      peak_breadth_mm: number;
      /** First row of the box around its taxels on its panel. */
      top: number;
      /** Last row of the box. */
      bottom: number;
      /** First column of the box. */
      left: number;
      /** Last column of the box. */
      right: number;
      /** Age of the form, frames; absent unless ages were requested. */
      form_age?: number | null;
      /** Normal force, N; absent if it is unknown. */
      force_n?: number | null;
    }[];
    /** Meaning of the touch. */
    intent: {
      /** The announced intention: `none`, `kindness`, `threat` or `attack`. */
      leading: string;
      /** Activation of each concept of the map, -1 to 1. */
      concepts: Record<string, number>;
    };
    /** Ids of the contacts that have ended since the last frame; absent if none has. */
    released?: number[];
    /** True for a key frame, which is decoded without the frames before it. */
    key: boolean;
    /** True if the image could be decoded. */
    decoded: boolean;
    /** Messages lost so far. */
    lost: number;
    /** Images left out so far, because the link had no room. */
    thinned: number;
    /** Pressure by panel; absent unless requested. */
    panels?: {
      /** Name of the panel. */
      name: string;
      /** Pressure of each taxel by row, counts. */
      rows: number[][];
    }[] | null;
    /** Force on each panel, N; null where a panel has none, absent if it is unknown. */
    force_n?: (number | null)[] | null;
    /** Basis of the forces: `calibrated`, `nominal` or `simulated`; absent if they are unknown. */
    force_basis?: string | null;
    /** Touch that is felt, for people. */
    felt: {
      /** The strongest touch, its place and force, and the number of others: `a touch on the back, 8 N, and 2 more`. */
      what: string;
      /** Such a text with the greatest force of the strongest touch so far: reported once it has ended. */
      peak: string;
      /** The announced intention, or why none is; empty while nothing touches. */
      meaning: string;
    };
    /** Shape of each contact for people: `touch` unless the recogniser is sure of it. */
    shapes: string[];
    /** Time since the beginning, us, of a recording. */
    at_us?: number;
    /** Number of jumps in time, of a recording. */
    seeks?: number;
    /** Contacts and forces on the robot; absent without a body. */
    pressing?: {
      /** Type of the message. */
      type: "pressing";
      /** Number of the scan. */
      frame: number;
      /** Start of the scan, us of the board. */
      time_us: number;
      /** Time of the poses in force, us of the board: of links that stand still, when it received them. Null without poses. */
      posed_us: number | null;
      /** Time from there to the start of the scan, us; below 0 if the poses came after it. Null without poses. */
      pose_age_us: number | null;
      /** The most by which a place in the frame of the poses is off, m, because joints are not known exactly and move on: by what the host that sends the poses knows of the joints. Null if it does not say it. */
      pose_error_m: number | null;
      /** The contacts that have a place. */
      contacts: {
        /** Id of the contact. */
        id: number;
        /** Name of the link. */
        link: string;
        /** Place, m. */
        at_m: [number, number, number];
        /** Direction away from the robot. */
        normal: [number, number, number];
        /** Force, counts. */
        force_counts: [number, number, number];
        /** Force, N; absent if it is unknown. */
        force_n?: [number, number, number] | null;
        /** Place in the frame of the poses; null without a pose of the link. */
        base: {
          /** Place, m. */
          at_m: [number, number, number];
          /** Direction away from the robot. */
          normal: [number, number, number];
          /** Force, counts. */
          force_counts: [number, number, number];
          /** Force, N; absent if it is unknown. */
          force_n?: [number, number, number] | null;
        } | null;
        /** Uncertainty by saturated and faulty taxels; null if there is none. */
        uncertain: {
          /** Number of saturated taxels: with one or more, the force is the least that it may be. */
          saturated: number;
          /** Number of faulty taxels under the contact, or at its edge. */
          faulty: number;
          /** The most by which the faulty ones press less than is counted for them, counts. */
          less_counts: number;
          /** The most by which they press more, counts. */
          more_counts: number;
          /** The most by which they move the centre of pressure, m. */
          off_m: number;
        } | null;
      }[];
      /** The links that something presses on. */
      links: {
        /** Name of the link. */
        link: string;
        /** Sum of the taxels' forces along their normals, counts. */
        force_counts: [number, number, number];
        /** Their moment about the link's origin, counts times m. */
        moment_counts_m: [number, number, number];
        /** Sum of their magnitudes, counts. */
        pressed_counts: number;
        /** The force, N; absent if it is unknown, as are the two below. */
        force_n?: [number, number, number] | null;
        /** The moment, N m. */
        moment_nm?: [number, number, number] | null;
        /** The sum of the magnitudes, N. */
        pressed_n?: number | null;
        /** Centre of pressure, m. */
        center_m: [number, number, number];
        /** Uncertainty by saturated and faulty taxels; null if there is none. */
        uncertain: {
          /** Number of saturated taxels: with one or more, the force is the least that it may be. */
          saturated: number;
          /** Number of faulty taxels under the contact, or at its edge. */
          faulty: number;
          /** The most by which the faulty ones press less than is counted for them, counts. */
          less_counts: number;
          /** The most by which they press more, counts. */
          more_counts: number;
          /** The most by which they move the centre of pressure, m. */
          off_m: number;
        } | null;
      }[];
      /** Basis of the forces in newtons: `calibrated`, `nominal` or `simulated`; absent if they are unknown. */
      force_basis?: string | null;
    };
    /** True if the image is from before the page was opened. */
    past?: boolean;
  };
  /** Time, us of the board, and total, counts, of each frame since the last image, newest last. */
  samples: [number, number][];
  /** Images that were not sent because of a newer one. */
  replaced: number;
  /** Samples and lines that were dropped, because the page did not read. */
  missed: number;
};

/** Places of the taxels on the robot. */
export type BodyLine = {
  /** Type of the message. */
  type: "body";
  /** Name of the body. */
  name: string;
  /** The links: all of a robot, each after its parent; without a robot those that taxels lie on. */
  links: {
    /** Name of the link. */
    name: string;
    /** Number of the link that it hangs on; null for the root, and without a robot. */
    parent: number | null;
  }[];
  /** Number of the link, place (m) and direction away from the robot of each taxel, in the frame of the link; null for a taxel without a place. */
  taxels: ([number, [number, number, number], [number, number, number]] | null)[];
};

/** Poses of the robot's links. */
export type PosesLine = {
  /** Type of the message. */
  type: "poses";
  /** Pose of each link in the frame of the root, by its name. */
  links: Record<string, {
    /** Origin, m. */
    at_m: [number, number, number];
    /** Rotation: a quaternion x, y, z, w of length 1. */
    turn: [number, number, number, number];
  }>;
};

/** Figure of the robot. */
export type FigureLine = {
  /** Type of the message. */
  type: "figure";
  /** The links that have a shape. */
  links: {
    /** Name of the link. */
    name: string;
    /** Corners in the frame of the link, m. */
    points: [number, number, number][];
    /** Triangles: numbers of their corners, counter-clockwise as seen from outside. */
    triangles: [number, number, number][];
  }[];
};

/** Folds of the garment at its posture. The docs of the fields are the descriptions in `view/page/messages.d.ts`. */
export type FoldingLine = {
  /** Type of the message. */
  type: "folding";
  /** True if the posture is known. */
  followed: boolean;
  /** Taxels on which the folds press at this posture, as they were learned; if it is not known, all on which they may. */
  taxels: number[];
};

/** The pressure just before a moment of a recording. */
export type GlowLine = {
  /** Type of the message. */
  type: "glow";
  /** The moment, us of the board. */
  time_us: number;
  /** Number of jumps in time. */
  seeks: number;
  /** Taxels and their pressure, counts, fading with its age. */
  taxels: [number, number][];
};

/** Faults of lines and inputs. */
export type PinsLine = {
  /** Type of the message. */
  type: "pins";
  /** Number of faults. */
  faults: number;
  /** A sentence for each, or one if there are none. */
  table: string[];
};

/** The taxel under the pointer. */
export type TaxelLine = {
  /** Type of the message. */
  type: "taxel";
  /** Number of the taxel. */
  taxel: number;
  /** Scan of the code; null before it has come. */
  frame: number | null;
  /** Raw code; null before it has come. */
  code: number | null;
  /** Block that reads it; null if none does. */
  block: number | null;
  /** Row in that block; null if it has none. */
  wired_row: number | null;
  /** Column in that block; null if it has none. */
  wired_column: number | null;
};

/** State of the link. */
export type LinkLine = {
  /** Type of the message. */
  type: "link";
  /** Frames of the board, 1/s. */
  rate: number;
  /** Frames received. */
  frames: number;
  /** Messages lost. */
  lost: number;
  /** Images left out, because the link had no room. */
  thinned: number;
  /** Frames of the wire that were refused. */
  refused: number;
  /** Restarts of the board. */
  restarts: number;
  /** Half of the last round trip to the board, ms; null if unknown. */
  latency_ms: number | null;
  /** Number of open pages. */
  pages: number;
};

/** A line of the log. */
export type SayLine = {
  /** Type of the message. */
  type: "say";
  /** `onset`, `release`, `intention`, `reaction`, `gesture`, `gap` or `note`. */
  kind: string;
  /** Time, us of the board; null if it has none. */
  time_us: number | null;
  /** The sentence. */
  said: string;
};

/** The log so far. */
export type LogLine = {
  /** Type of the message. */
  type: "log";
  /** Lines, the oldest first. */
  said: {
    /** Type of the message. */
    type: "say";
    /** `onset`, `release`, `intention`, `reaction`, `gesture`, `gap` or `note`. */
    kind: string;
    /** Time, us of the board; null if it has none. */
    time_us: number | null;
    /** The sentence. */
    said: string;
  }[];
};

/** Causes of a concept's activation, in shares of the sum that causes it. */
export type WhyLine = {
  /** Type of the message. */
  type: "why";
  /** Name of the concept. */
  concept: string;
  /** Activation, -1 to 1. */
  activation: number;
  /** Share of each input over all its paths, the greatest first. */
  inputs: [string, number][];
  /** The paths, the greatest share first. */
  paths: {
    /** Names of the concepts from an input to the last before the explained one. */
    concepts: string[];
    /** The share. */
    share: number;
  }[];
  /** Shares due to no input, by reason. */
  rest: [string, number][];
  /** Sum of the paths and the rest. */
  sum: number;
};

/** The stream has ended. */
export type EndLine = {
  /** Type of the message. */
  type: "end";
  /** The reason, for people. */
  text: string;
};

/** Tools that can press the garment of a simulated board. */
export type HandLine = {
  /** Type of the message. */
  type: "hand";
  /** The tools. */
  tools: {
    /** Name. */
    name: string;
    /** Length and width, mm. */
    size_mm: [number, number];
    /** Force of a short press, N. */
    force_n: number;
    /** Most that a long press comes to, N. */
    most_n: number;
  }[];
  /** The scripts that can be played. */
  scripts: {
    /** Name. */
    name: string;
    /** Title. */
    title: string;
  }[];
  /** Name of the script that plays; null if none does. */
  playing: string | null;
  /** Number of touches by hand that are kept: they can be played again and saved. */
  touches: number;
};

/** What pages can set on the board, and have set. */
export type SetupLine = {
  /** Type of the message. */
  type: "setup";
  /** Limits and filter of the board's scene. */
  limits: {
    /** Pressure below this many counts is 0: 1 to 4095. */
    floor: number;
    /** Pressure of a contact's taxels, counts: 1 to 4095. */
    low: number;
    /** Peak with which a contact begins, counts: `low` to 4095. */
    high: number;
    /** Smallest area of a contact, taxels: 1 to 256. */
    min_area: number;
    /** The filter: `off`, `conservative`, `median`, `square` or `persistent`. */
    filter: string;
  };
  /** Number of steps that can be undone. */
  undo: number;
  /** True if the board has been set since it was saved. */
  unsaved: boolean;
  /** True if the board is simulated: it is asked nothing that would need a question. */
  simulated: boolean;
  /** True if pages may only look. */
  read_only: boolean;
};

/** The last message of a type is no longer valid. */
export type NoneLine = {
  /** Type of the message. */
  type: "none";
  /** The type. */
  of: string;
};

/** State of the player of a recording. */
export type PlayerLine = {
  /** Type of the message. */
  type: "player";
  /** Time since the beginning, s. */
  at: number;
  /** Duration of the recording, s. */
  duration: number;
  /** First and last moment that is played, s. */
  range: [number, number];
  /** Multiple of the recorded speed. */
  speed: number;
  /** True if the range is repeated. */
  loop: boolean;
  /** False while paused. */
  playing: boolean;
  /** Number of jumps in time. */
  seeks: number;
};

/** Summary of a recording. */
export type OverviewLine = {
  /** Type of the message. */
  type: "overview";
  /** Duration of the recording, us. */
  duration_us: number;
  /** Time up to which everything is known, us since the beginning. */
  known_us: number;
  /** Duration of a part, us. */
  width_us: number;
  /** Greatest total of each part, counts. */
  totals: number[];
  /** Changes of the leading intention: us since the beginning, name. */
  intentions: [number, string][];
  /** Lines of the log: us since the beginning, kind, text. */
  said: [number, string, string][];
  /** Number of lines about contacts that were left out. */
  unlisted: number;
};

/** A robot of several boards, one of which the page shows. */
export type RobotLine = {
  /** Type of the message. */
  type: "robot";
  /** Name of the robot. */
  name: string;
  /** Name of the board that the page shows. */
  board: string;
  /** All boards, in the order of the robot's file. */
  boards: {
    /** Name of the board. */
    name: string;
    /** `live`, or `absent`, `lost`, `other`, `over`, `failed`: its picture is not live. */
    state: string;
    /** Host time at which it was last live, us since 1970; null if it is, or never was. */
    since_us: number | null;
    /** Reason why it is not live. */
    why: string | null;
    /** Contacts on it. */
    contacts: number;
    /** Counts per newton on its taxels; null if unknown. */
    counts_per_newton: number | null;
  }[];
};

/** Meaning of the touches of all boards to the robot. */
export type RobotIntentLine = {
  /** Type of the message. */
  type: "robot_intent";
  /** The host's time, us since 1970. */
  host_time_us: number;
  /** The announced intention: `none`, `kindness`, `threat` or `attack`. */
  leading: string;
  /** Names of the concepts with causes that hold: of at least 0.5, and then down to 0.4. */
  holding: string[];
  /** Activation of each concept of the map, -1 to 1. */
  concepts: Record<string, number>;
  /** Inputs of the map for which nothing is known that is young enough, so that its default counts: names of their concepts. */
  defaults: string[];
  /** Contacts on the robot, and whose motion has caused them. */
  touches: {
    /** Number of the board, in the order of the robot's file. */
    board: number;
    /** Id of the board's contact. */
    contact: number;
    /** Region on which it lies. */
    region: string;
    /** Link on which it lies. */
    link: string;
    /** Pressure, counts; with a calibration in force the force, thousandths of a newton. */
    load: number;
    /** `own` if the robot's motion has caused it, `other` if that of what touches it, or `unsure`. */
    mover: string;
    /** Motion of the robot's surface before the onset; absent if it is not known. */
    approach?: {
      /** Speed along the normal, m/s; positive outwards. */
      normal_m_s: number;
      /** Whole speed, m/s. */
      speed_m_s: number;
    };
    /** Properties of the object that the robot has moved into; absent of what touches it. */
    probe?: {
      /** Greatest force over greatest depth, counts/mm, the depth of at least half a millimetre; none before that depth or 2,000 counts. */
      hardness?: number;
      /** Share of the force on the taxel with the greatest pressure, at the greatest force, percent. */
      point: number;
      /** Greatest speed of the contact along the surface, mm/s. */
      slide: number;
      /** Greatest change of the force while the limb was still, percent. */
      stir: number;
    };
  }[];
  /** The announced intention and what holds, in words. */
  text: string;
};

/** A request of a page. */
export type PageRequest = {
  hover: number | null;
} | {
  tare: number;
} | {
  why: {
    /** The concept; null for the strongest intention. */
    of: string | null;
    /** Activation of each concept of the map, -1 to 1, in the order of the map. */
    concepts: number[];
  };
} | {
  /** Press of a finger. */
  press: {
    /** Number of the finger, 0 to 9. */
    finger: number;
    /** Name of the tool. */
    tool: string;
    /** Index of the panel. */
    panel: number;
    /** Centre, taxels of the panel: along the columns, along the rows. */
    at: [number, number];
    /** Force, N: 0 to 200. */
    force_n: number;
    /** Direction of the tool's length, degrees from +x towards +y. */
    angle_deg: number;
  };
} | {
  release: number;
} | {
  script: string;
} | {
  /** Order about what was pressed. */
  hand: "again" | "clear";
} | {
  /** Limits and filter of a scene. */
  limits: {
    /** Pressure below this many counts is 0: 1 to 4095. */
    floor: number;
    /** Pressure of a contact's taxels, counts: 1 to 4095. */
    low: number;
    /** Peak with which a contact begins, counts: `low` to 4095. */
    high: number;
    /** Smallest area of a contact, taxels: 1 to 256. */
    min_area: number;
    /** The filter: `off`, `conservative`, `median`, `square` or `persistent`. */
    filter: string;
  };
} | {
  /** Order about what was set on the board. */
  setup: "undo" | "save";
} | {
  play: boolean;
} | {
  seek: number;
} | {
  speed: number;
} | {
  loop: boolean;
} | {
  range: [number, number] | null;
} | {
  step: number;
};
