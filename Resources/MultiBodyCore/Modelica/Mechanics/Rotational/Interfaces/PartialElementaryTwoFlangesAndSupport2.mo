within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialElementaryTwoFlangesAndSupport2 "Component with two flanges and, if wanted, a support"
  parameter Boolean useSupport=false "= true, if the support exists, else the housing stands still";
  Flange_a flange_a "First flange" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Flange_b flange_b "Second flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Support support(phi=phi_support, tau=-flange_a.tau - flange_b.tau) if useSupport "Housing" annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
protected
  SI.Angle phi_support "Angle of the housing";
equation
  if not useSupport then
    phi_support = 0;
  end if;
  annotation (Documentation(info="<html><p>Base class of gears. The housing takes the reaction of both flanges.</p></html>"));
end PartialElementaryTwoFlangesAndSupport2;
