within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialTwoFlanges "Component with two flanges"
  Flange_a flange_a "First flange" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Flange_b flange_b "Second flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  annotation (Documentation(info="<html><p>Base class of components between two flanges.</p></html>"));
end PartialTwoFlanges;
