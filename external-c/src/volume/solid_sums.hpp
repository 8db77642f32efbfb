// Integrals over a solid and over the two sides of its surface.
#pragma once

namespace cmb::overlap {

// Over one side of the surface, seen along z.
struct SideSums {
  double area = 0.0, x = 0.0, y = 0.0;     // integrals of 1, x, y over its shadow
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double height = 0.0;                     // of z over its shadow

  void add(const SideSums &other, double factor) {
    area += factor * other.area;
    x += factor * other.x, y += factor * other.y;
    xx += factor * other.xx, xy += factor * other.xy, yy += factor * other.yy;
    height += factor * other.height;
  }
};

// The solid's shadow is that of either side; lines along z that enter the solid more than once count as often.
struct SolidSums {
  double volume = 0.0, x = 0.0, y = 0.0, z = 0.0;  // integrals of 1, x, y, z
  SideSums upper, lower;

  void add(const SolidSums &other, double factor) {
    volume += factor * other.volume;
    x += factor * other.x, y += factor * other.y, z += factor * other.z;
    upper.add(other.upper, factor);
    lower.add(other.lower, factor);
  }
};

}  // namespace cmb::overlap
