#version 300 es
// Neither discards nor writes depth, so that hidden pixels are rejected before this runs.
precision highp float;
precision highp int;

flat in uint slot;
layout(location = 0) out uint nearest;

void main() { nearest = slot; }
