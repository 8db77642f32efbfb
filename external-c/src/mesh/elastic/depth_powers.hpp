// Integrals of powers of a depth that is linear over a triangle.
#pragma once

namespace cmb::mesh {

// Of the depths at a triangle's corners: sums of all products of so many of them, the same one as often as one likes. The mean of the k-th power of
// the depth is that of k by the number of such products: 3, 6, 10 and 15.
struct ProductsOfDepths {
  double of_one, of_two, of_three;

  ProductsOfDepths(double a, double b, double c) : of_one(a + b + c) {
    const double squares = a * a + b * b + c * c;
    of_two = 0.5 * (of_one * of_one + squares);
    of_three = squares * of_one + a * b * c;
    product_ = a * b * c;
    pairs_ = of_two - squares;
  }
  double of_four() const { return of_one * of_three - pairs_ * of_two + product_ * of_one; }
  // Of the three and one of them once more.
  double of_three_with(double d) const { return of_three + d * (of_two + d * (of_one + d)); }

 private:
  double product_, pairs_;
};

}  // namespace cmb::mesh
