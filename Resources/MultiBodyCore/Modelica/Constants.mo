within Modelica;
package Constants "Constants of mathematics, of the number format and of nature"
  extends Modelica.Icons.Package;
  import Modelica.Units.SI;

  final constant Real e(final unit="1") = 2.718281828459045235360287 "Base of the natural logarithm";
  final constant Real pi = 3.141592653589793238462643 "Half the circumference of the unit circle";
  final constant Real D2R(final unit="rad/deg") = pi/180 "One degree in radian";
  final constant Real R2D(final unit="deg/rad") = 180/pi "One radian in degree";
  final constant Real gamma(final unit="1") = 0.577215664901532860606512 "Euler-Mascheroni constant";
  final constant Real eps = 2.220446049250313e-16 "Relative spacing of double precision numbers, 2^(-52)";
  final constant Real small = 2.2250738585072014e-308 "Smallest normalized double precision number";
  final constant Real inf = 1.7976931348623157e308 "Largest double precision number";
  final constant Integer Integer_inf = 2147483647 "Largest Integer of 32 bits";
  final constant SI.Velocity c = 299792458 "Speed of light in vacuum";
  final constant SI.Acceleration g_n = 9.80665 "Standard acceleration of free fall on earth";
  final constant Real G(final unit="m3/(kg.s2)") = 6.67430e-11 "Newtonian constant of gravitation";
  annotation (Documentation(info="<html>
<p>Constants of mathematics, of IEEE 754 double precision numbers and of nature.
Sources: ISO 80000-3 (standard acceleration of free fall), CODATA 2018 (constant of gravitation), SI brochure (speed of light).</p>
</html>"));
end Constants;
