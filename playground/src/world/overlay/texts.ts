// Texts of one font and colour with an outline in the colour of the floor, kept as pictures: to draw letters costs many
// times as much as to copy them, and most texts are the same in the next picture of the world.

const FAMILY = 'system-ui, "Segoe UI", Roboto, sans-serif';
export const PLAIN = `12px ${FAMILY}`;
export const BOLD = `600 ${PLAIN}`;
/** Width of the outline, px. */
const OUTLINE = 3;
/** Height of a picture above and below the middle of its letters, px. */
const HALF = 10;
/** With more texts all are forgotten: states may be any number of texts. */
const MOST = 2000;

/** Where all of them are drawn. */
let easel: OffscreenCanvas | null = null;

interface Text {
  /** Width of the letters, px. */
  width: number;
  picture: ImageBitmap | null;
}

export class Texts {
  #texts = new Map<string, Text>();
  #look = { ratio: 0, color: "", floor: "" };

  constructor(private readonly font: string) {}

  /** Sets the pixels of the screen in a CSS pixel, and the colours of letters and floor. */
  use(ratio: number, color: string, floor: string): void {
    const look = this.#look;
    if (ratio === look.ratio && color === look.color && floor === look.floor) return;
    this.#forget();
    this.#look = { ratio, color, floor };
  }

  /** Width of the letters, px. */
  width(context: CanvasRenderingContext2D, text: string): number {
    return this.#find(context, text).width;
  }

  /** Draws a text that begins at `x`, its letters' middle at `y`. */
  draw(context: CanvasRenderingContext2D, text: string, x: number, y: number): void {
    const found = this.#find(context, text);
    found.picture ??= this.#drawn(text, found.width);
    if (!found.picture) return;
    const { ratio } = this.#look;
    // Between two pixels of the screen it would be blurred.
    const left = Math.round((x - OUTLINE) * ratio) / ratio;
    const top = Math.round((y - HALF) * ratio) / ratio;
    context.drawImage(found.picture, left, top, found.picture.width / ratio, found.picture.height / ratio);
  }

  #find(context: CanvasRenderingContext2D, text: string): Text {
    let found = this.#texts.get(text);
    if (found) return found;
    if (this.#texts.size >= MOST) this.#forget();
    context.font = this.font;
    found = { width: context.measureText(text).width, picture: null };
    this.#texts.set(text, found);
    return found;
  }

  #drawn(text: string, width: number): ImageBitmap | null {
    const { ratio, color, floor } = this.#look;
    easel ??= new OffscreenCanvas(1, 1);
    const context = easel.getContext("2d");
    if (!context) return null;
    // This also clears it, and resets the context.
    easel.width = Math.ceil((width + 2 * OUTLINE) * ratio);
    easel.height = Math.ceil(2 * HALF * ratio);
    context.scale(ratio, ratio);
    context.font = this.font;
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = OUTLINE;
    context.strokeStyle = floor;
    context.strokeText(text, OUTLINE, HALF);
    context.fillStyle = color;
    context.fillText(text, OUTLINE, HALF);
    return easel.transferToImageBitmap();
  }

  #forget(): void {
    for (const { picture } of this.#texts.values()) picture?.close();
    this.#texts.clear();
  }
}
