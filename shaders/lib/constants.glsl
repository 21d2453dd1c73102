// Numbers that several files need. Final literals: glslang folds constant expressions in double
// precision.
#ifndef FACET_CONSTANTS_GLSL
#define FACET_CONSTANTS_GLSL

const float PI = 3.14159265;
const float INV_PI = 0.318309886;
const float TWO_PI = 6.28318531;
const float INV_TWO_PI = 0.159154943;
const float INV_SQRT_PI = 0.564189584;
/// Stands for infinity where a comparison needs a finite number.
const float LARGEST = 3.0e38;

#endif
