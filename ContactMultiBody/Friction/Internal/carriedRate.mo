within ContactMultiBody.Friction.Internal;
pure function carriedRate "Rate of the stretch of a patch that turns with the bodies, and forgets what holds nothing"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position anchor[6] "Stretch of the patch: translation (1:3), turning times radius of gyration (4:6)";
  input Real normal[3](each unit="1") "Mean of the unit normals; shorter than one where the patch is bent";
  input Modelica.Units.SI.AngularVelocity w[3] "Mean angular velocity of the two bodies";
  input Real turningLost(unit="1") "Share of the turning that is forgotten, as the patch is a point";
  input Modelica.Units.SI.Time relaxationTime(min=Modelica.Constants.small) "Time in which an anchor that holds nothing is forgotten";
  output Modelica.Units.SI.Velocity rate[6] "Rate of the stretch";
protected
  constant Real bent(unit="1")=0.01 "By how much the mean normal of a flat patch may fall short of one";
  Real evenness(unit="1") "Length of the mean normal";
  Real unitNormal[3](each unit="1") "Direction of the mean normal";
  Real planar(unit="1") "1: the patch is flat, 0: it is bent";
  Modelica.Units.SI.AngularVelocity turning[3] "Angular velocity of the stretch";
  Modelica.Units.SI.Position translation[3] "Stretch by translation";
  Modelica.Units.SI.Position rotation[3] "Stretch by turning";
  Modelica.Units.SI.Velocity translationRate[3] "Rate of the stretch by translation";
  Modelica.Units.SI.Velocity rotationRate[3] "Rate of the stretch by turning";
algorithm
  translation := {anchor[1],anchor[2],anchor[3]};
  rotation := {anchor[4],anchor[5],anchor[6]};
  evenness := sqrt(normal*normal + Modelica.Constants.small);
  unitNormal := normal/evenness;
  planar := max(1 - (1 - evenness)/bent, 0);
  turning := (1 - planar)*w + planar*(w*unitNormal)*unitNormal;
  translationRate := cross(turning, translation) - planar*(translation*unitNormal)*unitNormal/relaxationTime;
  rotationRate := cross(turning, rotation) - (planar*(rotation - (rotation*unitNormal)*unitNormal) + turningLost*rotation)/
    relaxationTime;
  rate := {translationRate[1],translationRate[2],translationRate[3],rotationRate[1],rotationRate[2],rotationRate[3]};
  annotation (Inline=false, Documentation(info="<html>
<p>
A flat patch turns about its normal with the bodies, and forgets what would stretch its springs along the normal, or turn it about axes in its plane, as its normal turned. A patch
that is bent, such as that of a peg in a hole, turns with the bodies about all axes and forgets nothing.
</p>
</html>"));
end carriedRate;
