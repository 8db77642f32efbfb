within ContactMultiBody.Friction;
pure function anchorRate "Rate of the way between anchor and contact point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce "Normal force";
  input Modelica.Units.SI.Position stretch[3] "Way of the first body since the anchor was set";
  input Modelica.Units.SI.Velocity slidingVelocity[3] "Velocity of the first body against the second, tangential";
  input Real normal[3](each unit="1") "Unit normal of the contact";
  input Modelica.Units.SI.AngularVelocity spin "Mean angular velocity of the two bodies about the normal";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness "Stiffness of the static spring";
  input Real mu(min=0, unit="1") "Coefficient of friction at the present speed";
  input Modelica.Units.SI.Time relaxationTime "Time in which an anchor that holds nothing is forgotten";
  output Modelica.Units.SI.Velocity rate[3] "Derivative of the stretch";
protected
  constant Real elastic(unit="1")=0.9 "Share of the largest stretch up to which the anchor does not move";
  constant Modelica.Units.SI.Length shortest=1e-8 "Way over which the anchor starts to follow where hardly any force holds it";
  Modelica.Units.SI.Length size2 "Length of the stretch";
  Modelica.Units.SI.Length largest "Stretch at which the spring carries all the friction there is";
  Real outward[3](each unit="1") "Direction of the stretch";
  Real drag(unit="1") "Share of the outward speed that the anchor follows";
algorithm
  size2 := sqrt(stretch*stretch + Modelica.Constants.small);
  largest := mu*max(normalForce, 0)/stiffness;
  outward := stretch/size2;
  drag := min(max((size2 - elastic*largest)/((1 - elastic)*largest + shortest), 0), 2);
  rate := (if normalForce > 0 then slidingVelocity + spin*cross(normal, stretch) - drag*max(slidingVelocity*outward, 0)*
    outward else zeros(3)) - (max(1 - largest/size2, 0)*stretch + (stretch*normal)*normal)/relaxationTime;
  annotation (Inline=false, Documentation(info="<html>
<p>
The anchor stays where it is while the spring is stretched by less than 0.9 of &mu; F<sub>n</sub>/S: sticking is purely elastic, so
that nothing creeps under constant or changing load below 0.9 of the limit. From there on the anchor is dragged
along, fully when the limit is exceeded by 10 nm: without that length the start of a contact, where F<sub>n</sub> is nearly zero, would be
a switch. The stretch turns with the bodies about the normal. What exceeds the limit, because the normal force fell, and what stands along the normal, because
the contact turned, is forgotten within the relaxation time; so is all of it when the bodies part. Source: T. Juh&aacute;sz 2008,
equations 5 to 9; gradual drag as in P. Dupont, V. Hayward, B. Armstrong, F. Altpeter: Single state elastoplastic friction models. IEEE Transactions on Automatic
Control 47 (2002).
</p>
</html>"));
end anchorRate;
