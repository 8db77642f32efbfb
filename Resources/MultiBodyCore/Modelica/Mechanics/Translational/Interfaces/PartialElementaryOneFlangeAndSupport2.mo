within Modelica.Mechanics.Translational.Interfaces;
partial model PartialElementaryOneFlangeAndSupport2 "Component with a flange and, if wanted, a support"
  parameter Boolean useSupport=false "= true, if the support exists, else the housing stands still";
  SI.Length s "Position of the flange less that of the support";
  Flange_b flange "Flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Support support(s=s_support, f=-flange.f) if useSupport "Housing" annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
protected
  SI.Length s_support "Position of the housing";
equation
  s = flange.s - s_support;
  if not useSupport then
    s_support = 0;
  end if;
  annotation (Documentation(info="<html><p>Base class of sources. The housing takes the reaction of the flange.</p></html>"));
end PartialElementaryOneFlangeAndSupport2;
