// The files that a run is offered as, in the order they are made and shown.

import { computed } from '@preact/signals';
import { entry } from './store';

export interface FileKind {
  /** The engine's format; "job" and the drawn pictures come from the page. */
  format: string;
  title: string;
  /** Where the title is too long for a button. */
  short?: string;
  ending: string;
  /** Among those that are folded away. */
  more?: boolean;
  /** Made when it is asked for, since it takes longer. */
  onDemand?: boolean;
}

const kFlat: readonly FileKind[] = [
  { format: 'svg', title: 'SVG', ending: 'svg' },
  { format: 'dxf', title: 'DXF', ending: 'dxf' },
  { format: 'png', title: 'PNG', ending: 'png' },
  { format: 'bom.csv', title: 'bill of materials', short: 'Bill', ending: 'bom.csv' },
  { format: 'job', title: 'job', ending: 'json' },
  { format: 'csv', title: 'CSV', ending: 'csv', more: true },
  { format: 'json', title: 'GeoJSON', ending: 'geojson', more: true },
  { format: 'apng', title: 'animation', short: 'Animation', ending: 'animation.png', more: true, onDemand: true },
  { format: 'glb', title: 'GLB', ending: 'glb', more: true, onDemand: true },
  // The job names these two.
  { format: 'edges', title: 'edges.png', ending: 'png', more: true },
  { format: 'regions', title: 'regions.png', ending: 'png', more: true },
];

/** Of solid pieces. The PNG is the photo with their outlines. */
const kSolid: readonly FileKind[] = [
  { format: 'glb', title: 'GLB', ending: 'glb' },
  { format: 'csv', title: 'CSV', ending: 'csv' },
  { format: 'svg', title: 'SVG', ending: 'svg' },
  { format: 'dxf', title: 'DXF', ending: 'dxf' },
  { format: 'overlay.png', title: 'PNG', ending: 'outlines.png' },
  { format: 'job', title: 'job', ending: 'json' },
  { format: 'labels.png', title: 'label picture', short: 'Labels', ending: 'labels.png', more: true },
  { format: 'gltf', title: 'glTF', ending: 'gltf', more: true },
  { format: 'json', title: 'GeoJSON', ending: 'geojson', more: true },
];

/** Of wood: the folder as one file. */
const kWood: readonly FileKind[] = [
  { format: 'folder', title: 'ZIP', ending: 'zip' },
  { format: 'png', title: 'PNG', ending: 'png' },
  { format: 'job', title: 'job', ending: 'json' },
  { format: 'svg', title: 'SVG', ending: 'svg', more: true },
  { format: 'dxf', title: 'DXF', ending: 'dxf', more: true },
  { format: 'csv', title: 'CSV', ending: 'csv', more: true },
  { format: 'json', title: 'GeoJSON', ending: 'geojson', more: true },
];

export const fileKinds = computed(() => (entry.value.panels ? kWood : entry.value.solid ? kSolid : kFlat));

export const endingOf = (format: string): string =>
  fileKinds.value.find((file) => file.format === format)?.ending ?? format;
