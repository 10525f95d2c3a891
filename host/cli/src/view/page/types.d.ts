// Types that several modules of the page share. What comes from the program is in messages.d.ts.

import type {
  BodyLine,
  BudgetLine,
  EndLine,
  FigureLine,
  FoldingLine,
  GlowLine,
  HandLine,
  HealthLine,
  HealthMapLine,
  LostLine,
  ImageHead,
  LinkLine,
  LogLine,
  NoneLine,
  OverviewLine,
  PageHello,
  PageRequest,
  PinsLine,
  PlayerLine,
  PosesLine,
  RobotIntentLine,
  RobotLine,
  SayLine,
  SetupLine,
  TaxelLine,
  WhyLine,
} from "./messages.d.ts";

export type Triple = [number, number, number];

/** A panel of `hello`, with what the page adds. */
export interface Panel extends PanelOf {
  /** Its number, and that of its first taxel. */
  index: number;
  base: number;
  /** Size of a taxel. */
  mm: [number, number];
  /** Whether that is known. */
  known: boolean;
}

type PanelOf = PageHello["panels"][number];
export type CognitiveMapOf = NonNullable<PageHello["map"]>;
export type Concept = CognitiveMapOf["concepts"][number];
export type Palette = PageHello["palette"];
export type Hello = PageHello;

/** `hello`, with what the page adds. */
export interface Garment extends Omit<Hello, "panels" | "absent"> {
  panels: Panel[];
  /** 1 where there is no taxel. */
  absent: Uint8Array;
  /** Changes with the panels. */
  key: string;
}

/** The line of a frame. */
export type Frame = ImageHead["frame"];
export type Contact = Frame["contacts"][number];

/** The head of an image, as it is kept: `samples` are times and totals by turns. */
export interface Head extends Omit<ImageHead, "samples"> {
  samples: Float64Array;
  /** Where the robot's links were when it came; null if that is not known. */
  poses: PosesLine | null;
  /** Where the garment folded then; null if that is not known. */
  folding: FoldingLine | null;
  /** When it came, ms of the page. */
  came: number;
}

/** An image, as it comes. */
export interface ImageMessage extends ImageHead {
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
export type Said = OverviewLine["said"][number];
/** A line of the log as it is shown: its time, us, and whether its moment can be shown. */
export interface LogEntry {
  at: number | null;
  kind: string;
  said: string;
  leads: boolean;
}
export type LinkState = LinkLine;
export type Overview = OverviewLine;
export type BodyState = BodyLine;
export type PoseOfLink = PosesLine["links"][string];
export type Pressing = NonNullable<Frame["pressing"]>;

/** What presses on a robot, as it is drawn: places and directions in the frames of the links, forces in counts. */
export interface Pushed {
  contacts: {
    id: number;
    /** Its board, if there are several. */
    board?: string;
    link: string;
    at_m: Triple;
    normal: Triple;
    force_counts: Triple;
  }[];
  links: { link: string; pressed_counts: number }[];
}

export type PlayerState = PlayerLine;
export type TaxelState = TaxelLine;

/** The newest line of each type. */
export interface States {
  hello?: Hello;
  link?: LinkState;
  health_map?: HealthMapLine;
  health?: HealthLine;
  pins?: PinsLine;
  budget?: BudgetLine;
  taxel?: TaxelState;
  body?: BodyState;
  figure?: FigureLine;
  poses?: PosesLine;
  folding?: FoldingLine;
  end?: EndLine;
  lost?: LostLine;
  player?: PlayerState;
  glow?: GlowLine & { values?: Uint16Array };
  overview?: Overview;
  robot?: RobotLine;
  robot_intent?: RobotIntentLine;
  why?: WhyLine;
  /** What can be set on the board; only of a live one that the page may ask. */
  setup?: SetupLine;
  /** What presses the garment; only of a simulated board. */
  hand?: HandLine;
}

/** A text message. */
export type Line =
  | Hello
  | (Omit<NoneLine, "of"> & { of: keyof States })
  | SayLine
  | LogLine
  | { type: Exclude<keyof States, "hello"> };

/** What a page asks of the program. */
export type { PageRequest };
export type Ask = (request: PageRequest) => void;

export interface Settings {
  view: string;
  smooth: boolean;
  contours: boolean;
  contacts: boolean;
  peaks: boolean;
  folds: boolean;
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

/** A place on a panel: x along the columns and y along the rows, taxels; 0, 0 is the centre of the first one. */
export interface Spot {
  panel: Panel;
  at: [number, number];
}

/** Where places of a panel are on the page; null for one that has no place in the picture. */
export type Plot = (at: [number, number]) => [number, number] | null;

/** A view of the picture. */
export interface View {
  draw(store: import("./store.js").Store, settings: Settings): void;
  /** The place on the garment at a point of the page; absent if the view does not show where it is pressed. */
  aim?(point: [number, number]): Spot | null;
  plot?(panel: Panel): Plot;
}
