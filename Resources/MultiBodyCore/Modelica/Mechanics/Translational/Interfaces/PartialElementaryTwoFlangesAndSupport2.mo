within Modelica.Mechanics.Translational.Interfaces;
partial model PartialElementaryTwoFlangesAndSupport2 "Component with two flanges and, if wanted, a support"
  parameter Boolean useSupport=false "= true, if the support exists, else the housing stands still";
  extends PartialTwoFlanges;
  Support support(s=s_support, f=-flange_a.f - flange_b.f) if useSupport "Housing" annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
  SI.Length s_a "Position of flange_a less that of the support";
  SI.Length s_b "Position of flange_b less that of the support";
protected
  SI.Length s_support "Position of the housing";
equation
  s_a = flange_a.s - s_support;
  s_b = flange_b.s - s_support;
  if not useSupport then
    s_support = 0;
  end if;
  annotation (Documentation(info="<html><p>Base class of gears. The housing takes the reaction of both flanges.</p></html>"));
end PartialElementaryTwoFlangesAndSupport2;
