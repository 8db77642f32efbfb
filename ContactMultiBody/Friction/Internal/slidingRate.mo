within ContactMultiBody.Friction.Internal;
pure function slidingRate "Velocity with which a patch that slides wholly drags its anchor along"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position anchor[6] "Stretch of the patch: translation (1:3), turning times radius of gyration (4:6)";
  input Real share[:](each unit="1") "Share of the stiffness at each point";
  input Real arm[size(share, 1), 3](each unit="1") "Lever of each point about the centre of the patch, by the radius of gyration";
  input Real normal[size(share, 1), 3](each unit="1") "Unit normals";
  input Modelica.Units.SI.Velocity sliding[size(share, 1), 3] "Tangential velocities";
  input Modelica.Units.SI.Velocity speed "Root mean square of the sliding speeds";
  input Modelica.Units.SI.Velocity motion[6] "Velocity of the patch";
  input Modelica.Units.SI.Length limit "Stretch at which the spring of a point carries all the friction there is";
  output Modelica.Units.SI.Velocity rate[6] "Velocity of the anchor";
protected
  constant Real slow(unit="1")=1e-3 "Share of the patch's speed below which a point has less than its sliding friction";
  constant Real least(unit="1")=0.1 "Least cosine between the velocity of the patch and its steady stretch";
  constant Modelica.Units.SI.Velocity rest=1e-12 "Speed of a patch that has no direction";
  Modelica.Units.SI.Velocity patchSpeed "Magnitude of the velocity of the patch";
  Real direction[6](each unit="1") "Direction of the velocity of the patch";
  Real pointDirection[size(share, 1), 3](each unit="1") "Direction in which each point slides";
  Modelica.Units.SI.Position friction[6] "Sum of the points' sliding friction by the stiffness";
  Modelica.Units.SI.Position image[6] "What the springs would give if they were stretched by that sum";
  Modelica.Units.SI.Position steady[6] "Stretch whose springs give the points' sliding friction";
  Real steady2(unit="m2") "Square of that stretch";
  Modelica.Units.SI.Length power "Power of the points' sliding friction by stiffness and speed of the patch";
  Real drag[6](each unit="1") "Way of the anchor by that of the patch";
  Modelica.Units.SI.Length outward "Stretch in the direction of the velocity";
algorithm
  patchSpeed := sqrt(motion*motion + rest^2);
  direction := motion/patchSpeed;
  for k in 1:size(share, 1) loop
    pointDirection[k, :] := sliding[k, :]/sqrt(sliding[k, :]*sliding[k, :] + (slow*speed)^2);
  end for;
  friction := limit*patchSum(share, arm, pointDirection);
  image := patchSum(share, arm, pointStretches(friction, arm, normal));
  steady := (friction*friction)/(friction*image + Modelica.Constants.small)*friction;
  steady2 := steady*steady + Modelica.Constants.small;
  power := max(direction*steady, least*sqrt(steady2));
  drag := power/steady2*(anchor - (steady*anchor)/steady2*steady) + (direction*anchor)/power*direction;
  outward := max(direction*anchor, 0);
  rate := patchSpeed*outward/sqrt(max(anchor*drag, 0)*power + Modelica.Constants.small)*drag;
  annotation (Inline=false, Documentation(info="<html>
<p>
The rate is P q with a symmetric matrix P that is never negative, so that the anchor never gains energy by it: q P q &#8805; 0. It is made such that the velocity of the patch and the rate agree where q is the stretch q<sub>s</sub>
whose springs give the sum of the points' sliding friction -&mu; F<sub>n</sub> v/|v|: with the direction d of the patch's velocity V
</p>
<blockquote><pre>
P q = |V| max(d q, 0)/sqrt((q D q)(d q_s)) D q,    D = (d q_s)/q_s^2 (1 - q_s q_s'/q_s^2) + d d'/(d q_s)
</pre></blockquote>
<p>
D is the symmetric matrix that maps q<sub>s</sub> to d and is otherwise as round as can be (that of the secant methods of optimization). The first factor is the cosine of the angle between stretch and velocity: an anchor is
dragged outward only. For one point P q = max(v q, 0) q/q<sup>2</sup>, the flow normal to the circle of the largest friction.
</p>
</html>"));
end slidingRate;
