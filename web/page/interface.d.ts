/** What the page does for the module, which cannot do it by itself. */
export interface Host {
  /** Saves a file as the browser saves downloads. */
  save(name: string, type: string, bytes: Uint8Array<ArrayBuffer>): void;

  /**
   * How far the device is tilted from where it was level, to the right and to the upper edge of the
   * screen, each in [-1, 1]; null if it does not tell.
   */
  tilt(): [right: number, up: number] | null;

  /**
   * Begins to feel how the device is held; the present pose is level. Some browsers ask whoever
   * watches, and allow that only in answer to a click or touch.
   *
   * @returns whether the device tells
   */
  askForTilt(): Promise<boolean>;

  /** Puts this behind the `#` of the page's address. */
  showFragment(fragment: string): void;

  /** Puts text on the clipboard. */
  copy(text: string): void;

  /**
   * Begins a film of pictures of this size in pixels.
   *
   * @throws an error in words for people if this browser cannot make films
   */
  beginFilm(width: number, height: number, framesPerSecond: number): Film;
}

/** A film in the making. */
export interface Film {
  /**
   * Adds a frame: rows of RGBA from above, shown from `seconds` on. Frames come in order of time;
   * the film begins with the first. They are copied here and encoded when their turn comes.
   */
  add(pixels: Uint8Array, seconds: number): void;

  /**
   * Encodes what is left, then saves the film. What follows the last point of the name is replaced
   * by what the film has become, `mp4` or `webm`.
   */
  finish(name: string): void;

  /**
   * Whether so many frames wait for the encoder that the next should wait, too. Nothing is lost if
   * it does not, until memory for waiting frames is used up: then the film ends early, and `error`
   * says so.
   */
  readonly busy: boolean;

  /** Frames that wait for the encoder. */
  readonly waiting: number;

  /** The file's name once it is saved. */
  readonly saved: string | null;

  /** What went wrong, for people. */
  readonly error: string | null;
}
