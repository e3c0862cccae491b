// The sheen of fibres that stand up from cloth: A. C. Estevez, C. Kulla, "Production Friendly Microfacet Sheen BRDF", 2017,
// with the cheaper visibility of D. Neubelt, M. Pettineo, "Crafting a Next-Gen Material Pipeline for The Order: 1886", 2013.
const float PI = 3.14159265;
const float SHEEN_ROUGHNESS = 0.4;

// Reflectance for a light, times the cosine to it and pi.
float sheenReflected(float normalHalf, float normalLight, float normalEye) {
  const float inverse = 1.0 / SHEEN_ROUGHNESS;
  float distribution = (2.0 + inverse) * pow(max(1.0 - normalHalf * normalHalf, 1e-4), 0.5 * inverse) / (2.0 * PI);
  float visibility = 0.25 / (normalLight + normalEye - normalLight * normalEye);
  return PI * distribution * visibility * normalLight;
}

// The part of a uniform sky's light that comes back: the integral over all its directions, fitted to within 0.012.
float sheenAlbedo(float normalEye) {
  float x = 1.0 - normalEye, x2 = x * x, x4 = x2 * x2;
  return 0.065 + 0.285 * x + 0.20 * x2 + 0.21 * x4 * x4;
}
