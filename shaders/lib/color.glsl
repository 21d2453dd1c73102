// Colours: linear, Rec. 709 primaries.
#ifndef FACET_COLOR_GLSL
#define FACET_COLOR_GLSL

/// Relative luminance.
float luminance(vec3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

#endif
