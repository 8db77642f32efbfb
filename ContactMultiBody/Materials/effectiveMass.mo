within ContactMultiBody.Materials;
pure function effectiveMass "Effective mass of a pair of bodies"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Mass m1(min=Modelica.Constants.small) "Mass of the first body";
  input Modelica.Units.SI.Mass m2(min=Modelica.Constants.small)=Modelica.Constants.inf "Mass of the second body; infinite: immovable";
  output Modelica.Units.SI.Mass m "Effective mass";
algorithm
  m := 1/(1/m1 + 1/m2);
  annotation (Documentation(info="<html>
<p>
m = 1/(1/m<sub>1</sub> + 1/m<sub>2</sub>), for a central impact. Where bodies also turn, the effective mass at the contact is smaller;
bodies held by joints may have more.
</p>
</html>"));
end effectiveMass;
