// Types that several modules of the page share. Messages are those of host/cli/src/view/message.rs.

export type Triple = [number, number, number];

/** A panel of `hello`, with what the page adds. */
export interface Panel {
  name: string;
  region: string;
  link: string;
  rows: number;
  columns: number;
  pitch_um: [number, number];
  /** Its number, and that of its first taxel. */
  index: number;
  base: number;
  /** Size of a taxel. */
  mm: [number, number];
  /** Whether that is known. */
  known: boolean;
}

export interface Concept {
  name: string;
  layer: number;
}

export interface Edge {
  from: number;
  to: number;
  weight: number;
}

export interface CognitiveMapOf {
  concepts: Concept[];
  edges: Edge[];
}

/** Colours and scale of pressure, and colours of the intentions. */
export interface Palette {
  ramp: Triple[];
  bands: number;
  /** End of the scale at the beginning, and its least and greatest, counts. */
  start: number;
  ends: [number, number];
  intentions: Record<string, string>;
}

/** `hello`, with what the page adds. */
export interface Garment {
  garment: string;
  label: string;
  scene: string;
  firmware: string;
  calibration: string;
  counts_per_newton: number | null;
  /** Counts at which a contact ends. */
  low: number;
  map: CognitiveMapOf | null;
  palette: Palette;
  panels: Panel[];
  taxels: number;
  /** 1 where there is no taxel. */
  absent: Uint8Array;
  /** Changes with the panels. */
  key: string;
}

/** `hello`, as it comes. */
export interface Hello extends Omit<Garment, "panels" | "taxels" | "absent" | "key"> {
  type: "hello";
  panels: Omit<Panel, "index" | "base" | "mm" | "known">[];
  absent?: { panel: number; row: number; column: number; rows: number; columns: number }[];
}

export interface Contact {
  id: number;
  panel: number;
  panel_name: string;
  region: string;
  shape: string;
  total: number;
  area: number;
  x: number;
  y: number;
  vx: number;
  vy: number;
  slip: boolean;
  azimuth: number | null;
  anisotropy: number;
  peak_row: number;
  peak_column: number;
}

/** The line of a frame. */
export interface Frame {
  frame: number;
  time_us: number;
  contacts: Contact[];
  intent: { leading: string; concepts: Record<string, number> };
  /** Of a recording: time since its beginning, and number of jumps. */
  at_us?: number;
  seeks?: number;
  /** From before the page was opened. */
  past?: boolean;
}

/** The head of an image, as it is kept: `samples` are times and totals by turns. */
export interface Head {
  frame: Frame;
  samples: Float64Array;
  replaced: number;
  missed: number;
}

/** An image, as it comes. */
export interface ImageMessage {
  frame: Frame;
  samples: [number, number][];
  replaced: number;
  missed: number;
  image: Uint16Array;
  highest: Uint16Array;
}

/** An image that is shown. */
export interface Shown {
  number: number;
  head: Head;
  image: Uint16Array;
}

/** An image at which the page pauses. */
export interface Still extends Shown {
  end: number;
  glow: Float32Array;
}

/** Time, kind and text of a line of the log. */
export type Said = [number, string, string];

export interface LinkState {
  rate: number;
  frames: number;
  lost: number;
  thinned: number;
  latency_ms: number | null;
  pages: number;
}

export interface PlayerState {
  at: number;
  duration: number;
  range: [number, number];
  speed: number;
  loop: boolean;
  playing: boolean;
  seeks: number;
}

export interface Overview {
  known_us: number;
  duration_us: number;
  totals: number[];
  width_us: number;
  intentions: [number, string][];
  said: Said[];
  unlisted: number;
}

/** The newest line of each type. */
export interface States {
  hello?: Hello;
  link?: LinkState;
  health_map?: { ill?: { taxel: number; health: string }[] };
  health?: Record<"scans" | "failed" | "overruns" | "lost" | "refused" | "scan_us" | "process_us", number>;
  pins?: { faults: number; told: string[] };
  budget?: object;
  taxel?: TaxelState;
  end?: { text: string };
  player?: PlayerState;
  glow?: { time_us: number; seeks: number; taxels: [number, number][]; values?: Uint16Array };
  overview?: Overview;
}

export interface TaxelState {
  taxel: number;
  code: number | null;
  block: number | null;
  wired_row: number | null;
  wired_column: number | null;
}

/** A text message. */
export type Line =
  | Hello
  | { type: "none"; of: keyof States }
  | { type: "say"; text: string; kind: string; time_us: number | null; said: string }
  | { type: Exclude<keyof States, "hello"> };

/** What a page asks of the program. */
export type Wish =
  | { hover: number | null }
  | { tare: number }
  | { play: boolean }
  | { seek: number }
  | { step: number }
  | { speed: number }
  | { loop: boolean }
  | { range: [number, number] | null };

export type Ask = (wish: Wish) => void;

export interface Settings {
  view: string;
  smooth: boolean;
  contours: boolean;
  contacts: boolean;
  peaks: boolean;
  glow: boolean;
  held: boolean;
  /** End of the scale, counts; 0 before the program has said where it begins. */
  top: number;
  auto: boolean;
  theme: string | null;
  /** Whether keys act without a focus. */
  keys: boolean;
}

/** A taxel that is pointed at, and where on the page. */
export interface Place {
  panel: Panel;
  row: number;
  column: number;
  x: number;
  y: number;
  /** Chosen by the keys. */
  byKeys?: boolean;
}

/** A view of the picture. */
export interface View {
  draw(store: import("./store.js").Store, settings: Settings): void;
}
