// A small picture for each technique, in the accent's and the text's colours.

export const PavementIcon = () => (
  <svg viewBox="0 0 40 40" aria-hidden="true" class="technique-icon">
    <path class="soft" d="M4 4h8v7H4zM14 4h9v8l-9-1zM25 4h11v6l-11 2zM4 13l8 1v7l-8-1zM28 13l8-1v8l-7 1z" />
    <path class="full" d="M14 14l11 1 2 7-12-1zM4 23l9 1 1 6-10 1zM15 24l11 1-1 6-9-1zM28 24l8-1v8l-9 1z" />
    <path class="soft" d="M4 33l10-1v4H4zM16 33l9 1v2h-9zM27 34l9-1v3h-9z" />
  </svg>
);

export const MosaicIcon = () => (
  <svg viewBox="0 0 40 40" aria-hidden="true" class="technique-icon">
    <path
      class="full"
      d="M17 4h6v6h-6zM25.5 5.5l5 3-3 5-5-3zM9.5 8.5l5-3 3 5-5 3zM31 13l3.5 5-5 3-3-5zM5.5 18L9 13l4.5 3-3 5z"
    />
    <path
      class="soft"
      d="M17 16h6v6h-6zM29 23h6v6h-6zM5 23h6v6H5zM24 24l4 4-4 4-4-4zM13 25l4 3-3 4-4-3zM12 33h6v3h-6zM24 34h7v2h-7z"
    />
  </svg>
);

export const PebblesIcon = () => (
  <svg viewBox="0 0 40 40" aria-hidden="true" class="technique-icon">
    <ellipse class="full" cx="14" cy="13" rx="9" ry="7" transform="rotate(-18 14 13)" />
    <ellipse class="soft" cx="29" cy="15" rx="6" ry="8" transform="rotate(14 29 15)" />
    <ellipse class="soft" cx="11" cy="28" rx="6" ry="7" transform="rotate(30 11 28)" />
    <ellipse class="full" cx="26" cy="30" rx="9" ry="5.5" transform="rotate(-8 26 30)" />
  </svg>
);

export const PatternIcon = () => (
  <svg viewBox="0 0 40 40" aria-hidden="true" class="technique-icon">
    <path class="soft" d="M4 4h13l-3 11-10 4zM24 22l12-5v10l-9 3zM4 30l9-5 6 11H4z" />
    <path class="full" d="M19 4h17v11l-13 5-7-5zM4 22l11-5 7 5 3 8-5 4-6-11-10 5zM27 32l9-3v7H22z" />
  </svg>
);

export const ParquetryIcon = () => (
  <svg viewBox="0 0 40 40" aria-hidden="true" class="technique-icon">
    <path class="full" d="M4 4h15v7H4zM4 13h15v7H4zM21 22h7v14h-7zM30 22h6v14h-6z" />
    <path class="soft" d="M21 4h7v16h-7zM30 4h6v16h-6zM4 22h15v6H4zM4 30h15v6H4z" />
  </svg>
);
