// Corners of a grid that people have laid, as the parameter "pins" has them (core/parquetry/pins.h):
// "3,4:123.5,87.2; 5,4:150,88".

export interface Vertex {
  readonly column: number;
  readonly row: number;
}

export interface Pin extends Vertex {
  /** mm. */
  readonly x: number;
  readonly y: number;
}

const isOf = (vertex: Vertex) => (pin: Pin) => pin.column === vertex.column && pin.row === vertex.row;

export const readPins = (text: string): Pin[] =>
  text
    .split(/[;\s]+/)
    .filter(Boolean)
    .map((word) => {
      const [column = NaN, row = NaN, x = NaN, y = NaN] = word.split(/[:,]/).map(Number);
      return { column, row, x, y };
    });

export const writePins = (pins: readonly Pin[]): string =>
  pins.map(({ column, row, x, y }) => `${column},${row}:${x},${y}`).join('; ');

export const pinOf = (text: string, vertex: Vertex): Pin | undefined => readPins(text).find(isOf(vertex));

export const withoutPin = (text: string, vertex: Vertex): string => {
  const isIt = isOf(vertex);
  return writePins(readPins(text).filter((pin) => !isIt(pin)));
};
