// Coefficients of the elementary functions (near-minimax polynomials, lowest power first), fitted
// for this project in 30-digit arithmetic by Chebyshev interpolation. shaders/lib/elementary.glsl
// evaluates them; the CPU reference uses the C library's functions instead, so that an error here
// shows as a difference. A macro per table, since the two languages spell array constants
// differently.
#ifndef FACET_SHARED_ELEMENTARY_COEFFICIENTS_H
#define FACET_SHARED_ELEMENTARY_COEFFICIENTS_H

// exp(r) = 1 + r + r^2 P(r), |r| <= 1.02 ln(2)/2
#define FACET_EXP_COEFFICIENTS 0.5, 0.1666656963, 0.04166654542, 0.008364380693, 0.001392768462
// log(1 + f) = f - f^2/2 + f^3 P(f), sqrt(1/2) <= 1 + f <= sqrt(2)
#define FACET_LOG_COEFFICIENTS                                                           \
  0.3333333118, -0.2499999696, 0.2000071575, -0.1666780232, 0.1424905765, -0.1242568733, \
      0.1168541992, -0.1147973385, 0.06971611471
// sin(x) = x + x^3 P(x^2) and cos(x) = 1 - x^2/2 + x^4 P(x^2), |x| <= pi/4
#define FACET_SIN_COEFFICIENTS -0.1666666466, 0.008332748271, -0.0001958789088
#define FACET_COS_COEFFICIENTS 0.04166666466, -0.001388830304, 2.454794209e-5
// atan(x) = x + x^3 P(x^2), |x| <= tan(pi/8)
#define FACET_ATAN_COEFFICIENTS \
  -0.3333333176, 0.1999954048, -0.142639556, 0.1074373149, -0.06451928208
// exp(x^2) erfc(x) = t P(t), t = 1/(1 + x/3), x >= 0
#define FACET_ERFCX_COEFFICIENTS                                                      \
  0.1880631917, 0.1880638627, 0.1775899905, 0.1570706882, 0.124819171, 0.09968688302, \
      0.04828443359, 0.01198633116, 0.06458896098, -0.08418516418, 0.02403166065
// erfinv(y) = y P(w - 5/2), w = -log(1 - y^2) <= 5
#define FACET_ERFINV_CENTRAL_COEFFICIENTS                                                       \
  1.50140936, 0.2466402791, -0.004177392875, -0.001252726392, 0.0002183493862, -4.972419689e-6, \
      -3.463985268e-6, 4.681313481e-7, 2.33359672e-8, -8.93192597e-9
// erfinv(y) = y P(sqrt(w) - 3), 5 <= w <= 17
#define FACET_ERFINV_TAIL_COEFFICIENTS                                                        \
  2.832977062, 1.001675585, 0.009432913901, -0.007643271109, 0.005781242834, -0.003603283683, \
      0.001248650914, 3.45694232e-5, -0.0001196603303

#endif
